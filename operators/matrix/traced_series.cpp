#include "operators/matrix/traced_series.h"

#include "operators/matrix/camera_vector.h"
#include "operators/matrix/light_vector.h"
#include "operators/matrix/reflection_matrix.h"
#include "operators/matrix/series_rest.h"
#include "operators/matrix/sides.h"
#include "operators/matrix/transport_matrix.h"
#include "operators/series/neumann_series.h"

#include <optional>
#include <span>

namespace neumann {

namespace {

// P, prolongation: a function on the coarser patches as one on the finer ones.
template <int C>
class Prolongation {
public:
    using Domain = ExitantVector<C>;
    using Range = ExitantVector<C>;

    Prolongation(const PatchSpace& fine, std::span<const std::uint32_t> around) : fine_(&fine), around_(around) {}
    Range operator()(const Domain& x) const {
        Range result = Range::zero(fine_->size());
        for (std::uint32_t u = 0; u < fine_->size(); ++u) result.col(u) = x.col(around_[u]);
        return result;
    }

private:
    const PatchSpace* fine_;
    std::span<const std::uint32_t> around_;  // the coarser unknown of each finer one
};

// M = P*: the means of a function on the finer patches over the coarser ones.
template <int C>
class CoarseMeans {
public:
    using Domain = ExitantVector<C>;
    using Range = ExitantVector<C>;

    CoarseMeans(const PatchSpace& fine, const PatchSpace& coarse, std::span<const std::uint32_t> around)
        : fine_(&fine), coarse_(&coarse), around_(around) {}
    Range operator()(const Domain& x) const {
        Range result = Range::zero(coarse_->size());
        for (const Facet& facet : fine_->facets())
            for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u)
                result.col(around_[u]) += x.col(u) * fine_->measure(facet);
        for (const Facet& facet : coarse_->facets())
            for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u) result.col(u) /= coarse_->measure(facet);
        return result;
    }

private:
    const PatchSpace *fine_, *coarse_;
    std::span<const std::uint32_t> around_;
};

// An operator that asks a Watch before every use whether to stop.
template <Operator A>
class Stoppable {
public:
    using Domain = typename A::Domain;
    using Range = typename A::Range;

    Stoppable(A a, const Watch& watch) : a_(std::move(a)), watch_(&watch) {}
    Range operator()(const Domain& f) const {
        if (watch_->stop()) throw Stopped();
        return a_(f);
    }

private:
    A a_;
    const Watch* watch_;
};

// Le, K Le, K² Le, … and the rest; calls look(series, term) for each term. `direct`: a sampled b = K Le, which begins the series of
// L − Le.
template <int C, class Op, class Look>
TracedSeries series_of(const Op& product, const ExitantVector<C>& Le, const std::optional<ExitantVector<C>>& direct,
                       const PatchSpace& space, const PatchSpace& coarser, const TracedSeriesSettings& settings, const Watch& watch,
                       const Look& look) {
    const std::vector<std::uint32_t> around = space.coarser_of_each(coarser);
    const CoarseMeans<C> M(space, coarser, around);
    const Stoppable K(product, watch);
    const auto K_coarse = M * K * Prolongation<C>(space, around);

    const int N = settings.bounces, first = direct ? 1 : 0;
    TracedSeries series{FieldStack(space, N), FieldStack(coarser, N)};
    const auto keep = [&](int i, const ExitantVector<C>& term, const ExitantVector<C>& coarse_term) {
        series.fine.set<C>(i, term);
        series.coarse.set<C>(i, coarse_term);
        look(series, term);
    };
    if (direct) keep(0, Le, M(Le));
    NeumannSeries terms(K, direct ? *direct : Le);
    NeumannSeries coarse_terms(K_coarse, M(terms.term()));
    for (int i = first; i <= N; ++i) {
        if (i > first) {
            terms.advance();
            coarse_terms.advance();
        }
        keep(i, terms.term(), coarse_terms.term());
    }
    if (!settings.rest) return series;
    const auto rest_after = [&](const auto& op, const ExitantVector<C>& term) {
        auto rest = rest_of_series<C>(op, term);
        if (first > N) rest.sum = rest.sum + term;  // b itself has no picture
        return rest;
    };
    const SeriesRest<C> rest = rest_after(K, terms.term());
    series.fine.set<C>(N + 1, rest.sum);
    series.rest_converges = rest.converges;
    if (rest.converges) series.coarse.set<C>(N + 1, rest_after(K_coarse, coarse_terms.term()).sum);
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
        series_of<C>(R * TransportMatrix<C>(table), emitted_light<C>(scene, space), direct, space, coarser, settings, watch,
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
    TracedSeries series = series_of<C>(adjoint(R * TransportMatrix<C>(table)),
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
