// R on a patch space: what leaves a facet is the mean of what its rays bring, times its albedo. Materials only.
//
// A patch's albedo is the mean of its points'; rows then sum to it, so that ‖R‖∞ is at most the largest albedo and the white
// furnace holds to rounding on any mesh.
#pragma once

#include "core/scene/scene.h"
#include "operators/matrix/transport_matrix.h"

namespace neumann {

template <int C>
class ReflectionMatrix {
public:
    using Domain = IncidentVector<C>;
    using Range = ExitantVector<C>;

    ReflectionMatrix(const Materials& materials, const PatchSpace& space);

    Range operator()(const Domain& g) const;

    // Of each facet.
    const Eigen::Array<double, C, Eigen::Dynamic>& albedo() const { return albedo_; }

private:
    Eigen::Array<double, C, Eigen::Dynamic> albedo_;
};

extern template class ReflectionMatrix<1>;
extern template class ReflectionMatrix<4>;

}  // namespace neumann
