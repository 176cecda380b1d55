#include "operators/matrix/reflection_matrix.h"

#include "core/base/hot.h"
#include "core/sampling/sobol_sampler.h"

#include <oneapi/tbb/parallel_for.h>

namespace neumann {

namespace {

// Rays that one thread reflects at least: waking another costs as much.
constexpr std::size_t rays_at_once = 1 << 16;

// Channels of an unknown as the processor's registers hold them; memory need not be aligned to them.
template <int C>
struct Lanes;
template <>
struct Lanes<1> {
    using Type = double;
};
template <>
struct Lanes<4> {
    typedef double Type __attribute__((vector_size(32), aligned(8), may_alias));
};

// The means of what the rays of the facets [begin, end) bring, times albedo. Four partial sums: additions wait for each other.
template <int C>
NEUMANN_HOT void reflect(const RayTable& table, const double* source, const double* albedo, std::uint32_t begin, std::uint32_t end,
                         double* result) {
    using Lane = typename Lanes<C>::Type;
    const auto at = [&](std::uint32_t unknown) -> const Lane& {
        return *reinterpret_cast<const Lane*>(source + std::size_t{C} * unknown);
    };
    for (std::uint32_t f = begin; f < end; ++f) {
        const auto row = table.row(f);
        const std::uint32_t* seen = row.data();
        const std::size_t n = row.size();
        Lane sum[4] = {};
        std::size_t i = 0;
        for (; i + 4 <= n; i += 4)
            for (std::size_t k = 0; k < 4; ++k) sum[k] += at(seen[i + k]);
        for (; i < n; ++i) sum[0] += at(seen[i]);
        const Lane& a = *reinterpret_cast<const Lane*>(albedo + std::size_t{C} * f);
        const std::size_t u = table.space().facets()[f].first;
        *reinterpret_cast<Lane*>(result + C * u) = ((sum[0] + sum[1]) + (sum[2] + sum[3])) / static_cast<double>(n) * a;
    }
}

Rgb mean_albedo(const Materials& materials, const PatchSpace& space, const Facet& facet, const SobolPoints& points,
                std::uint32_t number) {
    Rgb sum(0.0);
    SobolSampler sampler(points, 0, number);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        sampler.start(i);
        const SurfacePoint p = space.patches().point(facet.patch, sampler.next2());
        const Bsdf* bsdf = materials.at(p, facet.front);
        if (!bsdf) return Rgb(0.0);
        const Rgb albedo = diffuse_albedo(*bsdf, p);
        if (is_constant(*bsdf)) return albedo;
        sum += albedo;
    }
    return sum / static_cast<double>(points.size());
}

}  // namespace

template <int C>
ReflectionMatrix<C>::ReflectionMatrix(const Materials& materials, const PatchSpace& space)
    : albedo_(C, static_cast<Eigen::Index>(space.facets().size())) {
    const SobolPoints points(16);
    oneapi::tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(space.facets().size()), [&](std::uint32_t f) {
        albedo_.col(f) = to_channels<C>(mean_albedo(materials, space, space.facets()[f], points, f));
    });
}

template <int C>
ExitantVector<C> ReflectionMatrix<C>::operator()(const Domain& g) const {
    const RayTable& table = g.table();
    const auto facets = static_cast<std::uint32_t>(table.space().facets().size());
    ExitantVector<C> result(C, table.space().size() + 1);
    result.col(table.space().nothing()).setZero();
    const auto work = [&](std::uint32_t begin, std::uint32_t end) {
        reflect<C>(table, g.source().data(), albedo_.data(), begin, end, result.data());
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
