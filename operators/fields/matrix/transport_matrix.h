// T on a patch space: the incident radiance of a facet's cell of directions is the mean radiance that its rays see. T depends on
// geometry alone.
//
// T* adds the importance at the start of each ray to the unknown that the ray sees.
#pragma once

#include "operators/fields/matrix/patch_field.h"
#include "operators/fields/matrix/ray_table.h"

#include <memory>

namespace neumann {

template <int C>
class AdjointTransportMatrix;

template <int C>
class TransportMatrix {
public:
    using Domain = ExitantVector<C>;
    using Range = IncidentVector<C>;

    // Keeps a reference to the table.
    explicit TransportMatrix(const RayTable& table) : table_(&table) {}

    // The means of the table's rows; in cells without a row nothing is set.
    Range operator()(const Domain& f) const;
    // Sorts the rays by the unknown that they see.
    AdjointTransportMatrix<C> adjoint() const;
    // The entries of row u, the incident radiance in the cell of unknown u.
    template <class Each>
    void for_row(std::uint32_t u, const Each& each) const {
        const auto seen = table_->row_of_cell(u);
        const double part = 1.0 / static_cast<double>(seen.size());
        for (const std::uint32_t v : seen)
            if (v != table_->space().nothing()) each(v, part);
    }

private:
    const RayTable* table_;
};

template <int C>
class AdjointTransportMatrix {
public:
    using Domain = IncidentVector<C>;
    using Range = ExitantVector<C>;

    explicit AdjointTransportMatrix(const RayTable& table);

    Range operator()(const Domain& g) const;
    TransportMatrix<C> adjoint() const { return TransportMatrix<C>(*table_); }
    template <class Each>
    void for_row(std::uint32_t u, const Each& each) const {
        const PatchSpace& space = table_->space();
        const double part = 1.0 / space.measure(space.facets()[space.facet_of(u)]);
        for (const std::uint32_t v : seers_->of(u)) each(v, table_->measure(space.facet_of(v)) * part);
    }

private:
    // For each unknown, the unknowns from which the rays that see it start, in the order of the rays.
    class Seers {
    public:
        explicit Seers(const RayTable& table);
        std::span<const std::uint32_t> of(std::uint32_t unknown) const {
            return {arrives_in_.data() + first_[unknown], arrives_in_.data() + first_[unknown + 1]};
        }

    private:
        std::vector<std::uint64_t> first_;
        std::vector<std::uint32_t> arrives_in_;
    };

    const RayTable* table_;
    std::shared_ptr<const Seers> seers_;
};

template <int C>
AdjointTransportMatrix<C> TransportMatrix<C>::adjoint() const {
    return AdjointTransportMatrix<C>(*table_);
}

extern template class TransportMatrix<1>;
extern template class TransportMatrix<4>;
extern template class AdjointTransportMatrix<1>;
extern template class AdjointTransportMatrix<4>;

}  // namespace neumann
