// One colour channel of K = R T, of which each process has the rows of its own unknowns (shared_rays.h). A row of K x
// has the same bits as in a TracedChannel.
#pragma once

#include "operators/algebra/channel_operator.h"
#include "operators/fields/matrix/reflection_matrix.h"
#include "operators/fields/shared/shared_rays.h"

namespace neumann {

class SharedChannel : public ChannelOperator {
public:
    // Keeps a reference to the rays.
    SharedChannel(const SharedRays& T, ReflectionMatrix<1> R);

    Eigen::Index size() const override { return T_->own(); }
    std::size_t first() const override { return T_->first(); }
    std::size_t unknowns() const override { return T_->all(); }
    const Agreement& agreement() const override { return *T_; }
    const Vector& measure() const override { return measure_; }

    void apply(const Vector& x, Vector& y) const override;
    void apply_adjoint(const Vector& x, Vector& y) const override;

    // This process has only rows; parts of the columns are on other processes.
    bool has_entries() const override { return false; }
    double row(Eigen::Index u, const Vector& x) const override;
    double diagonal(Eigen::Index u) const override;
    void add_column(Eigen::Index u, double a, Vector& y) const override;
    void for_row(Eigen::Index u, const Entry& each) const override;

    // The variance of (K* 1)_u, estimated by the rays that hit u, at each own unknown.
    Vector variance_of_power() const;

private:
    void reflect(Vector& means) const;
    // For each own unknown, the sum of each(power of the ray) over the rays that see it; g is the importance at the
    // starts of the rays.
    template <class Each>
    Vector to_seen(const Vector& g, const Each& each) const;

    const SharedRays* T_;
    ReflectionMatrix<1> R_;
    Vector measure_;
    std::vector<std::uint32_t> facet_of_;  // for each own unknown, the position of its facet in T_->facets()
};

}  // namespace neumann
