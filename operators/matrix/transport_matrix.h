// T on a patch space: what a ray brings is what the unknown that it sees sends. T f is not stored: it answers ray by ray, so that
// R(T f) touches each entry of the table once and K is never formed.
#pragma once

#include "operators/matrix/patch_field.h"
#include "operators/matrix/ray_table.h"

#include <utility>

namespace neumann {

// T f, one value a ray.
template <int C>
class IncidentVector {
public:
    IncidentVector(const RayTable& table, ExitantVector<C> f) : table_(&table), f_(std::move(f)) {}

    const RayTable& table() const { return *table_; }
    const ExitantVector<C>& source() const { return f_; }
    auto operator[](std::size_t ray) const { return f_.col(table_->seen()[ray]); }

private:
    const RayTable* table_;
    ExitantVector<C> f_;
};

template <int C>
class TransportMatrix {
public:
    using Domain = ExitantVector<C>;
    using Range = IncidentVector<C>;

    // The table is kept by reference.
    explicit TransportMatrix(const RayTable& table) : table_(&table) {}

    Range operator()(Domain f) const { return {*table_, std::move(f)}; }

private:
    const RayTable* table_;
};

}  // namespace neumann
