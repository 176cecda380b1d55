#include "operators/fields/matrix/reflection_matrix.h"

#include "core/sampling/sampler.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <map>
#include <tuple>

namespace neumann {

namespace {

// The least number of unknowns per task: with fewer, waking another thread costs more than it saves.
constexpr std::uint32_t unknowns_at_once = 1 << 14;

// The mean reflectance over a patch.
Rgb mean_reflectance(const Bsdf& bsdf, const PatchSpace& space, const Facet& facet, const SobolPoints& points,
                     std::uint32_t number) {
    Rgb sum(0.0);
    Sampler sampler(points, 0, number);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        sampler.start(i);
        const SurfacePoint p = space.patches().bare_point(facet.patch, sampler.next2());
        const Rgb rho = reflectance(bsdf, shading_point(space.geometry().shapes()[p.shape], p));
        if (is_constant(bsdf)) return rho;
        sum += rho;
    }
    return sum / static_cast<double>(points.size());
}

}  // namespace

template <int C>
ReflectionMatrix<C>::ReflectionMatrix(const Materials& materials, const PatchSpace& space) : space_(&space) {
    Reflectance rho = Reflectance::Zero(C, static_cast<Eigen::Index>(space.facets().size()));
    Blocks blocks(space.facets().size());
    const auto bsdf_of = [&](const Facet& facet) { return materials.at(space.patches().chart(facet.patch).shape(), facet.front); };
    const SobolPoints points(16);
    oneapi::tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(space.facets().size()), [&](std::uint32_t f) {
        const Facet& facet = space.facets()[f];
        if (const Bsdf* bsdf = bsdf_of(facet)) rho.col(f) = to_channels<C>(mean_reflectance(*bsdf, space, facet, points, f));
    });
    std::map<std::tuple<const Bsdf*, const Bsdf*, std::uint32_t>, std::shared_ptr<const ReflectionBlock>> known;
    for (std::size_t f = 0; f < blocks.size(); ++f) {
        const Facet& facet = space.facets()[f];
        const Bsdf* bsdf = bsdf_of(facet);
        if (facet.cells.k == 1 || !bsdf) continue;
        if (f + 1 < blocks.size() && space.facets()[f + 1].patch == facet.patch && transmits(*bsdf)) {
            const Facet& other = space.facets()[f + 1];
            auto& block = known[{bsdf, bsdf_of(other), facet.cells.k}];
            if (!block) block = std::make_shared<ReflectionBlock>(*bsdf, facet.cells, *bsdf_of(other), other.cells);
            blocks[f] = blocks[f + 1] = {block, facet.first};
            ++f;
            continue;
        }
        auto& block = known[{bsdf, nullptr, facet.cells.k}];
        if (!block) block = std::make_shared<ReflectionBlock>(*bsdf, facet.cells);
        blocks[f] = {block, facet.first};
    }
    reflectance_ = std::make_shared<const Reflectance>(std::move(rho));
    blocks_ = std::make_shared<const Blocks>(std::move(blocks));
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
    return {space, Reflectance::Ones(C, static_cast<Eigen::Index>(space.facets().size())),
            std::make_shared<const Blocks>(std::move(blocks)), 0};
}

template <int C>
ReflectionMatrix<1> ReflectionMatrix<C>::channel(int c) const {
    return {*space_, reflectance().row(C == 1 ? 0 : c), blocks_, channel_ + c};
}

template <int C>
void ReflectionMatrix<C>::reflect_cells(std::uint32_t f, double* values) const {
    const Facet& facet = space_->facets()[f];
    if (facet.cells.k == 1) {
        Eigen::Map<Eigen::Array<double, C, 1>>(values) *= reflectance().col(f);
        return;
    }
    const auto front = static_cast<Eigen::Index>(facet.cells.size());
    const Eigen::Index all = block(f) ? block(f)->rows() : front;
    Eigen::Map<Eigen::Array<double, C, Eigen::Dynamic>> cells(values, C, all);
    for (int c = 0; c < std::min(C, 3); ++c) {
        Eigen::VectorXd means = cells.row(c).transpose();
        if (const auto* B = block(f, c)) means = *B * means;
        means.head(front) *= reflectance()(c, f);
        if (all > front) means.tail(all - front) *= reflectance()(c, f + 1);
        cells.row(c) = means.transpose();
    }
}

template <int C>
typename ReflectionMatrix<C>::Values ReflectionMatrix<C>::reflect(Values means) const {
    const auto facets = static_cast<std::uint32_t>(space_->facets().size());
    const auto work = [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t f = begin; f < end; ++f)
            if (!goes_with_front(f)) reflect_cells(f, means.data() + C * std::size_t{space_->facets()[f].first});
    };
    if (space_->size() <= unknowns_at_once) {
        work(0, facets);
    } else {
        const std::uint32_t grain =
            std::max(1u, static_cast<std::uint32_t>(std::uint64_t{unknowns_at_once} * facets / space_->size()));
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, facets, grain),
                                  [&](const auto& range) { work(range.begin(), range.end()); });
    }
    return means;
}

template class ReflectionMatrix<1>;
template class ReflectionMatrix<4>;

}  // namespace neumann
