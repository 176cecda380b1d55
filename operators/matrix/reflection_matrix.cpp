#include "operators/matrix/reflection_matrix.h"

#include "core/base/hot.h"
#include "core/sampling/sobol_sampler.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <map>
#include <tuple>

namespace neumann {

namespace {

// Rays that one thread reflects at least: waking another costs as much.
constexpr std::size_t rays_at_once = 1 << 16;

// Channels of an unknown as the processor's registers hold them.
template <int C>
struct Lanes;
template <>
struct Lanes<1> {
    using Type = double;
};
template <>
struct Lanes<4> {
    typedef double Type __attribute__((vector_size(32), may_alias));
};

// The mean of what `rays` bring. Four partial sums: additions wait for each other.
template <int C>
void mean(const double* source, std::span<const std::uint32_t> rays, typename Lanes<C>::Type& result) {
    using Lane = typename Lanes<C>::Type;
    const auto at = [&](std::uint32_t unknown) -> const Lane& {
        return *reinterpret_cast<const Lane*>(source + std::size_t{C} * unknown);
    };
    Lane sum[4] = {};
    std::size_t i = 0;
    for (; i + 4 <= rays.size(); i += 4)
        for (std::size_t k = 0; k < 4; ++k) sum[k] += at(rays[i + k]);
    for (; i < rays.size(); ++i) sum[0] += at(rays[i]);
    result = ((sum[0] + sum[1]) + (sum[2] + sum[3])) / static_cast<double>(rays.size());
}

// The means over the cells of facets [begin, end), times the reflectance of those that have but one.
template <int C>
NEUMANN_HOT void find_means(const RayTable& table, const double* source, const double* reflectance, std::uint32_t begin,
                            std::uint32_t end, double* result) {
    using Lane = typename Lanes<C>::Type;
    for (std::uint32_t f = begin; f < end; ++f) {
        const Facet& facet = table.space().facets()[f];
        const auto row = table.row(f);
        const auto at = [&](double* to, std::size_t i) -> Lane& { return *reinterpret_cast<Lane*>(to + C * i); };
        if (facet.cells.k == 1) {
            Lane& value = at(result, facet.first);
            mean<C>(source, row, value);
            value *= *reinterpret_cast<const Lane*>(reflectance + std::size_t{C} * f);
            continue;
        }
        const std::size_t cells = facet.cells.size(), each = row.size() / cells;
        for (std::size_t j = 0; j < cells; ++j) mean<C>(source, row.subspan(j * each, each), at(result, facet.first + j));
    }
}

// The mean over a patch.
Rgb mean_reflectance(const Bsdf& bsdf, const PatchSpace& space, const Facet& facet, const SobolPoints& points,
                     std::uint32_t number) {
    Rgb sum(0.0);
    SobolSampler sampler(points, 0, number);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        sampler.start(i);
        const SurfacePoint p = space.patches().point(facet.patch, sampler.next2());
        const Rgb rho = reflectance(bsdf, shading_point(space.geometry().shapes()[p.shape], p));
        if (is_constant(bsdf)) return rho;
        sum += rho;
    }
    return sum / static_cast<double>(points.size());
}

}  // namespace

template <int C>
ReflectionMatrix<C>::ReflectionMatrix(const Materials& materials, const PatchSpace& space)
    : space_(&space),
      reflectance_(Reflectance::Zero(C, static_cast<Eigen::Index>(space.facets().size()))),
      blocks_(space.facets().size()) {
    const auto bsdf_of = [&](const Facet& facet) {
        return materials.at(space.patches().chart(facet.patch).shape(), facet.front);
    };
    const SobolPoints points(16);
    oneapi::tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(space.facets().size()), [&](std::uint32_t f) {
        const Facet& facet = space.facets()[f];
        if (const Bsdf* bsdf = bsdf_of(facet))
            reflectance_.col(f) = to_channels<C>(mean_reflectance(*bsdf, space, facet, points, f));
    });
    std::map<std::tuple<const Bsdf*, const Bsdf*, std::uint32_t>, std::shared_ptr<const ReflectionBlock>> known;
    for (std::size_t f = 0; f < blocks_.size(); ++f) {
        const Facet& facet = space.facets()[f];
        const Bsdf* bsdf = bsdf_of(facet);
        if (facet.cells.k == 1 || !bsdf) continue;
        if (f + 1 < blocks_.size() && space.facets()[f + 1].patch == facet.patch && transmits(*bsdf)) {
            const Facet& other = space.facets()[f + 1];
            auto& block = known[{bsdf, bsdf_of(other), facet.cells.k}];
            if (!block) block = std::make_shared<ReflectionBlock>(*bsdf, facet.cells, *bsdf_of(other), other.cells);
            blocks_[f] = blocks_[f + 1] = {block, facet.first};
            ++f;
            continue;
        }
        auto& block = known[{bsdf, nullptr, facet.cells.k}];
        if (!block) block = std::make_shared<ReflectionBlock>(*bsdf, facet.cells);
        blocks_[f] = {block, facet.first};
    }
}

template <int C>
ReflectionMatrix<C> ReflectionMatrix<C>::identity(const PatchSpace& space) {
    Blocks blocks;
    std::map<std::uint32_t, std::shared_ptr<const ReflectionBlock>> known;
    for (const Facet& facet : space.facets()) {
        auto& block = known[facet.cells.k];
        if (facet.cells.k > 1 && !block) block = std::make_shared<ReflectionBlock>(facet.cells);
        blocks.push_back({block, facet.first});
    }
    return {space, Reflectance::Ones(C, static_cast<Eigen::Index>(space.facets().size())), std::move(blocks), 0};
}

template <int C>
ReflectionMatrix<1> ReflectionMatrix<C>::channel(int c) const {
    return {*space_, reflectance_.row(C == 1 ? 0 : c), blocks_, channel_ + c};
}

// In place, with the back where it goes with the front.
template <int C>
void ReflectionMatrix<C>::reflect_cells(std::uint32_t f, double* values) const {
    const Facet& facet = space_->facets()[f];
    if (facet.cells.k == 1) {
        Eigen::Map<Eigen::Array<double, C, 1>>(values) *= reflectance_.col(f);
        return;
    }
    const auto front = static_cast<Eigen::Index>(facet.cells.size());
    const Eigen::Index all = blocks_[f].block ? blocks_[f].block->matrix(0).rows() : front;
    Eigen::Map<Eigen::Array<double, C, Eigen::Dynamic>> cells(values, C, all);
    for (int c = 0; c < std::min(C, 3); ++c) {
        Eigen::VectorXd means = cells.row(c).transpose();
        if (const auto* B = block(f, c)) means = *B * means;
        means.head(front) *= reflectance_(c, f);
        if (all > front) means.tail(all - front) *= reflectance_(c, f + 1);
        cells.row(c) = means.transpose();
    }
}

template <int C>
ExitantVector<C> ReflectionMatrix<C>::of_means(Range means) const {
    for (std::uint32_t f = 0; f < space_->facets().size(); ++f)
        if (!goes_with_front(f)) reflect_cells(f, means.data() + C * std::size_t{space_->facets()[f].first});
    return means;
}

template <int C>
ExitantVector<C> ReflectionMatrix<C>::operator()(const Domain& g) const {
    const RayTable& table = g.table();
    const auto facets = static_cast<std::uint32_t>(space_->facets().size());
    ExitantVector<C> result(C, space_->size() + 1);
    result.col(space_->nothing()).setZero();
    const auto work = [&](std::uint32_t begin, std::uint32_t end) {
        // Both sides of a patch are reflected together.
        for (std::uint32_t* f : {&begin, &end})
            if (*f < facets && goes_with_front(*f)) ++*f;
        find_means<C>(table, g.source().data(), reflectance_.data(), begin, end, result.data());
        for (std::uint32_t f = begin; f < end; ++f)
            if (const Facet& facet = space_->facets()[f]; facet.cells.k > 1 && !goes_with_front(f))
                reflect_cells(f, result.data() + C * std::size_t{facet.first});
    };
    if (table.seen().size() <= rays_at_once) {
        work(0, facets);
    } else {
        const std::size_t grain = std::max<std::size_t>(1, rays_at_once * facets / table.seen().size());
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, facets, grain),
                                  [&](const auto& range) { work(range.begin(), range.end()); });
    }
    return result;
}

template class ReflectionMatrix<1>;
template class ReflectionMatrix<4>;

}  // namespace neumann
