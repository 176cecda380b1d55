// The adjoints in ⟨f, g⟩: R* spreads what a facet's cells are worth over its rays, T* takes what each ray is worth to where it
// comes from, and K* = T* R* carries importance from the camera. ⟨We, K^i Le⟩ = ⟨K*^i We, Le⟩.
#pragma once

#include "operators/matrix/reflection_matrix.h"

#include <vector>

namespace neumann {

// A value for each ray.
template <int C>
class RayVector {
public:
    explicit RayVector(const RayTable& table) : values_(C, static_cast<Eigen::Index>(table.seen().size())) {}
    auto operator[](std::size_t ray) { return values_.col(static_cast<Eigen::Index>(ray)); }
    auto operator[](std::size_t ray) const { return values_.col(static_cast<Eigen::Index>(ray)); }

private:
    Eigen::Array<double, C, Eigen::Dynamic> values_;
};

// The rays that see each unknown.
class Seers {
public:
    explicit Seers(const RayTable& table);
    std::span<const std::uint64_t> of(std::uint32_t unknown) const {
        return {rays_.data() + first_[unknown], rays_.data() + first_[unknown + 1]};
    }

private:
    std::vector<std::uint64_t> first_, rays_;
};

template <int C>
class AdjointReflectionMatrix {
public:
    using Domain = ExitantVector<C>;
    using Range = RayVector<C>;

    AdjointReflectionMatrix(const ReflectionMatrix<C>& R, const RayTable& table) : R_(&R), table_(&table) {}

    Range operator()(const Domain& g) const {
        Range result(*table_);
        const ExitantVector<C> worth = R_->of_means(g);  // R = R*
        for (std::uint32_t f = 0; f < table_->space().facets().size(); ++f)
            for (std::size_t ray = table_->first_ray(f); ray < table_->first_ray(f + 1); ++ray)
                result[ray] = worth.col(table_->arrives_in(f, ray));
        return result;
    }

private:
    const ReflectionMatrix<C>* R_;
    const RayTable* table_;
};

template <int C>
class AdjointTransportMatrix {
public:
    using Domain = RayVector<C>;
    using Range = ExitantVector<C>;

    explicit AdjointTransportMatrix(const RayTable& table) : table_(&table), seers_(table), facet_of_ray_(table.seen().size()) {
        for (std::uint32_t f = 0; f < table.space().facets().size(); ++f)
            for (std::size_t ray = table.first_ray(f); ray < table.first_ray(f + 1); ++ray) facet_of_ray_[ray] = f;
    }

    Range operator()(const Domain& a) const {
        const PatchSpace& space = table_->space();
        Range result = Range::Zero(C, space.size() + 1);
        for (const Facet& facet : space.facets())
            for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u) {
                Channels<C> sum = Channels<C>::Zero(C);
                for (const std::uint64_t ray : seers_.of(u)) sum += a[ray] * table_->measure(facet_of_ray_[ray]);
                result.col(u) = sum / space.measure(facet);
            }
        return result;
    }

private:
    const RayTable* table_;
    Seers seers_;
    std::vector<std::uint32_t> facet_of_ray_;
};

}  // namespace neumann
