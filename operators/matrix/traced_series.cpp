#include "operators/matrix/traced_series.h"

#include "operators/matrix/light_vector.h"
#include "operators/matrix/reflection_matrix.h"
#include "operators/matrix/series_rest.h"
#include "operators/matrix/sides.h"
#include "operators/series/product.h"

namespace neumann {

namespace {

// P and M.
class Coarsening {
public:
    Coarsening(const PatchSpace& fine, const PatchSpace& coarse)
        : fine_(fine), coarse_(coarse), around_(fine.coarser_of_each(coarse)) {}

    template <int C>
    ExitantVector<C> prolong(const ExitantVector<C>& x) const {
        ExitantVector<C> result = ExitantVector<C>::Zero(C, fine_.size() + 1);
        for (std::uint32_t u = 0; u < fine_.size(); ++u) result.col(u) = x.col(around_[u]);
        return result;
    }
    template <int C>
    ExitantVector<C> mean(const ExitantVector<C>& x) const {
        ExitantVector<C> result = ExitantVector<C>::Zero(C, coarse_.size() + 1);
        for (const Facet& facet : fine_.facets())
            for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u)
                result.col(around_[u]) += x.col(u) * fine_.measure(facet);
        for (const Facet& facet : coarse_.facets())
            for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u) result.col(u) /= coarse_.measure(facet);
        return result;
    }

private:
    const PatchSpace &fine_, &coarse_;
    std::vector<std::uint32_t> around_;
};

template <int C>
TracedSeries trace(const Scene& scene, const PatchSpace& space, const PatchSpace& coarser, const TracedSeriesSettings& settings) {
    const RayTable table(space, settings.rays, settings.seed);
    const TransportMatrix<C> T(table);
    const ReflectionMatrix<C> R(scene.materials, space);
    const auto K = R * T;
    const Coarsening coarsening(space, coarser);

    const auto K_coarse = [&](const ExitantVector<C>& x) { return coarsening.mean<C>(K(coarsening.prolong<C>(x))); };

    TracedSeries series{FieldStack(space, settings.bounces), FieldStack(coarser, settings.bounces), table.seen().size()};
    ExitantVector<C> term = emitted_light<C>(scene, space), coarse_term = coarsening.mean<C>(term);
    const bool sample_lights = rays_that_meet_lights(scene, settings.rays) < enough_rays;
    const auto direct = [&] { return direct_light<C>(scene, R, settings.light_samples, settings.seed); };
    if (sample_lights) series.light_rays = std::uint64_t{settings.light_samples} * space.facets().size();
    series.rays += series.light_rays;
    for (int i = 0;; ++i) {
        series.fine.set<C>(i, term);
        series.coarse.set<C>(i, coarse_term);
        if (i == settings.bounces) break;
        term = i == 0 && sample_lights ? direct() : K(std::move(term));
        coarse_term = i == 0 && sample_lights ? coarsening.mean<C>(term) : K_coarse(coarse_term);
    }
    if (!settings.rest) return series;
    // Where the lights are sampled, bounce 1 is not K's.
    const bool begin = sample_lights && settings.bounces == 0;
    if (begin) term = direct();
    auto rest = rest_of_series<C>(K, term);
    if (begin) rest.sum += term;
    series.fine.set<C>(settings.bounces + 1, rest.sum);
    series.rest_converges = rest.converges;
    if (!rest.converges) return series;
    if (begin) coarse_term = coarsening.mean<C>(term);
    auto coarse_rest = rest_of_series<C>(K_coarse, coarse_term);
    if (begin) coarse_rest.sum += coarse_term;
    series.coarse.set<C>(settings.bounces + 1, coarse_rest.sum);
    return series;
}

}  // namespace

TracedSeries trace_series(const Scene& scene, const PatchSpace& space, const PatchSpace& coarser,
                          const TracedSeriesSettings& settings) {
    return is_grey(scene) ? trace<1>(scene, space, coarser, settings) : trace<4>(scene, space, coarser, settings);
}

}  // namespace neumann
