#include "operators/matrix/traced_series.h"

#include "operators/matrix/camera_vector.h"
#include "operators/matrix/light_vector.h"
#include "operators/matrix/reflection_matrix.h"
#include "operators/matrix/series_rest.h"
#include "operators/matrix/sides.h"
#include "operators/matrix/transport_matrix.h"
#include "operators/series/algebra.h"

#include <optional>

namespace neumann {

namespace {

// The operators P (prolongation) and M (means) between the two spaces.
class Coarsening {
public:
    Coarsening(const PatchSpace& fine, const PatchSpace& coarse)
        : fine_(fine), coarse_(coarse), around_(fine.coarser_of_each(coarse)) {}

    template <int C>
    ExitantVector<C> prolong(const ExitantVector<C>& x) const {
        ExitantVector<C> result = ExitantVector<C>::zero(fine_.size());
        for (std::uint32_t u = 0; u < fine_.size(); ++u) result.col(u) = x.col(around_[u]);
        return result;
    }
    template <int C>
    ExitantVector<C> mean(const ExitantVector<C>& x) const {
        ExitantVector<C> result = ExitantVector<C>::zero(coarse_.size());
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

// Computes x, K x, K² x, … and calls look(series, term) for each. `second`, if given, replaces K x.
template <int C, class Op, class Look>
TracedSeries apply_powers(const Op& product, ExitantVector<C> term, const std::optional<ExitantVector<C>>& second,
                          const PatchSpace& space, const PatchSpace& coarser, const TracedSeriesSettings& settings,
                          const Watch& watch, const Look& look) {
    const Coarsening coarsening(space, coarser);
    const auto K = [&](ExitantVector<C> x) {
        if (watch.stop()) throw Stopped();
        return product(std::move(x));
    };
    const auto K_coarse = [&](const ExitantVector<C>& x) { return coarsening.mean<C>(K(coarsening.prolong<C>(x))); };

    TracedSeries series{FieldStack(space, settings.bounces), FieldStack(coarser, settings.bounces)};
    ExitantVector<C> coarse_term = coarsening.mean<C>(term);
    for (int i = 0;; ++i) {
        series.fine.set<C>(i, term);
        series.coarse.set<C>(i, coarse_term);
        look(series, term);
        if (i == settings.bounces) break;
        term = i == 0 && second ? *second : K(std::move(term));
        coarse_term = i == 0 && second ? coarsening.mean<C>(term) : K_coarse(coarse_term);
    }
    if (!settings.rest) return series;
    // `second` is not K applied to x.
    const bool begin = second && settings.bounces == 0;
    if (begin) term = *second;
    auto rest = rest_of_series<C>(K, term);
    if (begin) rest.sum = rest.sum + term;
    series.fine.set<C>(settings.bounces + 1, rest.sum);
    series.rest_converges = rest.converges;
    if (!rest.converges) return series;
    if (begin) coarse_term = coarsening.mean<C>(term);
    auto coarse_rest = rest_of_series<C>(K_coarse, coarse_term);
    if (begin) coarse_rest.sum = coarse_rest.sum + coarse_term;
    series.coarse.set<C>(settings.bounces + 1, coarse_rest.sum);
    return series;
}

template <int C>
TracedSeries trace_light(const Scene& scene, const PatchSpace& space, const PatchSpace& coarser,
                         const TracedSeriesSettings& settings, const Watch& watch) {
    const RayTable table(space, settings.rays, settings.seed, watch);
    const ReflectionMatrix<C> R(scene.materials, space);
    const bool sample_lights = rays_that_meet_lights(scene, settings.rays) < enough_rays;
    std::optional<ExitantVector<C>> direct;
    if (sample_lights) direct = direct_light<C>(scene, R, settings.light_samples, settings.seed);
    const PowerBalance<C> balance(table, R);
    TracedSeries series =
        apply_powers<C>(R * TransportMatrix<C>(table), emitted_light<C>(scene, space), direct, space, coarser, settings, watch,
                        [&](TracedSeries& s, const ExitantVector<C>& term) { s.power.push_back(balance.of(term)); });
    if (sample_lights) series.light_rays = std::uint64_t{settings.light_samples} * space.facets().size();
    series.rays = table.seen().size() + series.light_rays;
    return series;
}

template <int C>
TracedSeries trace_adjoint(const Scene& scene, const PatchSpace& space, const PatchSpace& coarser,
                           const TracedSeriesSettings& settings, const Watch& watch) {
    const RayTable table(space, settings.rays, settings.seed, watch);
    const ReflectionMatrix<C> R(scene.materials, space);
    TracedSeries series = apply_powers<C>(adjoint(R * TransportMatrix<C>(table)),
                                          camera_importance<C>(scene, space, settings.camera_samples, settings.seed), {}, space,
                                          coarser, settings, watch, [](TracedSeries&, const ExitantVector<C>&) {});
    series.fine.average_over_directions();
    series.coarse.average_over_directions();
    series.rays = table.seen().size() + std::uint64_t{settings.camera_samples} * static_cast<std::uint64_t>(scene.film.crop_width) *
                                            static_cast<std::uint64_t>(scene.film.crop_height);
    return series;
}

}  // namespace

TracedSeries trace_series(const Scene& scene, const PatchSpace& space, const PatchSpace& coarser,
                          const TracedSeriesSettings& settings, const Watch& watch) {
    return is_grey(scene) ? trace_light<1>(scene, space, coarser, settings, watch)
                          : trace_light<4>(scene, space, coarser, settings, watch);
}

TracedSeries trace_importance(const Scene& scene, const PatchSpace& space, const PatchSpace& coarser,
                              const TracedSeriesSettings& settings, const Watch& watch) {
    return is_grey(scene) ? trace_adjoint<1>(scene, space, coarser, settings, watch)
                          : trace_adjoint<4>(scene, space, coarser, settings, watch);
}

}  // namespace neumann
