#include "operators/fields/matrix/traced_series.h"

#include "operators/algebra/algebra.h"
#include "operators/algebra/linked_series.h"
#include "operators/fields/matrix/camera_vector.h"
#include "operators/fields/matrix/chains.h"
#include "operators/fields/matrix/light_vector.h"
#include "operators/fields/matrix/link_light.h"
#include "operators/fields/matrix/scene_reflection.h"
#include "operators/fields/matrix/series_rest.h"
#include "operators/fields/matrix/sides.h"
#include "operators/fields/matrix/transport_matrix.h"

#include <functional>
#include <optional>
#include <span>

namespace neumann {

namespace {

// P, prolongation: maps a function on the coarser patches to one on the finer ones.
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

// The sum of all terms after the last one of the series. `light` is given to the first of these bounces.
template <int C, class Series>
SeriesRest<C> rest_after(const Series& series, const ExitantVector<C>* light) {
    const auto K = [&](const ExitantVector<C>& f) { return series.apply(f); };
    if (!series.has_links() && !light) return rest_of_series<C>(K, series.term());
    const ExitantVector<C> source = series.rest_source(light);
    SeriesRest<C> rest = rest_of_series<C>(K, source);
    rest.sum = std::move(rest.sum) + source;
    return rest;
}

// The light that is given to bounces in addition to what T carries: b = K Le in bounce 1, and light that comes by links
// (link_light.h) in later ones. The last entry is for all bounces beyond N. Empty if T carries all light.
template <int C>
using Sources = std::vector<ExitantVector<C>>;

// Le, K Le, K² Le, … and the rest; calls look(k, term) for each term.
template <int C, class Product, class Look>
TracedSeries series_of(const Product& product, int links, const ExitantVector<C>& Le, const Sources<C>& sources,
                       const RowShare& rows, const PatchSpace& coarser, const TracedSeriesSettings& settings, const Watch& watch,
                       const Look& look) {
    const PatchSpace& space = rows.space();
    const std::vector<std::uint32_t> around = space.coarser_of_each(coarser);
    const CoarseMeans<C> M(space, coarser, around);
    const Prolongation<C> P(space, around);
    const auto K = [&](const auto& field) {
        if (rows.any(watch.stop())) throw Stopped();
        return product(field);
    };
    const int N = settings.bounces;
    TracedSeries series{FieldStack(space, N), FieldStack(coarser, N)};
    if (sources.size() > 2) {
        series.fine_by_links.emplace(space, N);
        series.coarse_by_links.emplace(coarser, N);
    }
    const auto same = [](ExitantVector<C> f) { return f; };
    // The light given to bounce i by links, without b.
    const auto by_links = [&](int i) -> const ExitantVector<C>* {
        return i > 1 && sources.size() > 2 ? &sources[static_cast<std::size_t>(i)] : nullptr;
    };
    const auto coarse_by_links = [&](int i) {
        const ExitantVector<C>* light = by_links(i);
        if (!light) return std::optional<ExitantVector<C>>();
        std::optional coarse(M(*light));
        series.fine_by_links->set<C>(i, *light);
        series.coarse_by_links->set<C>(i, *coarse);
        return coarse;
    };
    const auto pointer = [](const auto& optional) { return optional ? &*optional : nullptr; };

    const int first = sources.empty() ? 0 : 1;
    if (first == 1) {
        series.fine.set<C>(0, Le);
        series.coarse.set<C>(0, M(Le));
        look(0, Le);
    }
    const ExitantVector<C>& begin = first == 1 ? sources[1] : Le;
    LinkedSeries terms(K, same, same, links, begin);
    LinkedSeries coarse_terms(K, P, M, links, M(begin));
    for (int i = first; i <= N; ++i) {
        const auto coarse_light = coarse_by_links(i);
        if (i > first) {
            terms.advance(by_links(i));
            coarse_terms.advance(pointer(coarse_light));
        }
        series.fine.set<C>(i, terms.term());
        series.coarse.set<C>(i, coarse_terms.term());
        look(i, terms.term());
    }
    if (!settings.rest) return series;
    const auto rest_of = [&](const auto& last, const ExitantVector<C>* light) {
        SeriesRest<C> rest = rest_after<C>(last, light);
        if (first > N) rest.sum = rest.sum + last.term();  // b itself has no picture
        return rest;
    };
    const auto coarse_light = coarse_by_links(N + 1);
    const SeriesRest<C> rest = rest_of(terms, by_links(N + 1));
    series.fine.set<C>(N + 1, rest.sum);
    series.rest_converges = rest.converges;
    if (rest.converges) series.coarse.set<C>(N + 1, rest_of(coarse_terms, pointer(coarse_light)).sum);
    return series;
}

// Whether points on lights are sampled, rather than found by the rays of T. Rays from patches, however many, rarely
// find the light of a small lamp by way of a mirror.
bool samples_lights(const Scene& scene, const TracedSeriesSettings& settings) {
    constexpr double small_part = 0.1;
    return rays_that_meet_lights(scene, settings.rays) < enough_rays ||
           (settings.glossy == Glossy::by_rays && (rays_that_meet_lights(scene, 1) < small_part || has_glossy_lights(scene)));
}

// Adds up the power over all processes.
void add_up(const RowShare& rows, std::vector<PowerOfTerm>& power) {
    std::vector<double> values;
    for (const PowerOfTerm& p : power) values.insert(values.end(), {p.emitted, p.left, p.caught, p.absorbed});
    rows.sum(values);
    for (std::size_t k = 0; k < power.size(); ++k)
        power[k] = {values[4 * k], values[4 * k + 1], values[4 * k + 2], values[4 * k + 3]};
}

template <int C>
TracedSeries trace_light(const Scene& scene, const RowShare& rows, const PatchSpace& coarser, const ReflectionMatrix<C>& R,
                         const TracedSeriesSettings& settings, const Watch& watch) {
    const PatchSpace& space = rows.space();
    Chains chains(scene, space, settings.rays, settings.seed, settings.bounces);
    std::function<void(const BlindRay&)> go_on;
    if (settings.glossy == Glossy::by_rays) go_on = [&](const BlindRay& ray) { chains.follow(ray); };
    const RayTable table(rows, settings.rays, settings.seed, watch, go_on, nullptr, settings.rough_rays);
    const std::size_t table_rays = RayTable::size(space, settings.rays);
    chains.finish();
    const int longest_chain = static_cast<int>(rows.largest(chains.longest()));
    const TransportMatrix<C> T(table);
    const PowerBalance<C> balance(table, R, chains);
    const ExitantVector<C> Le = emitted_light<C>(scene, space);
    std::vector<PowerOfTerm> power(static_cast<std::size_t>(settings.bounces) + 1);
    std::uint64_t light_rays = 0, link_rays = 0;
    Sources<C> sources;
    // If lights have no unknowns, only the power that arrives from them is known.
    const bool from_elsewhere = scene.emitters.has_environment() || scene.emitters.has_delta_lights() ||
                                (settings.glossy == Glossy::by_rays && has_glossy_lights(scene));
    const auto arrives = [&](std::size_t k, const IncidentVector<C>& means) {
        if (from_elsewhere) power[k - 1] += balance.arriving(means);
    };
    if (samples_lights(scene, settings)) {
        IncidentVector<C> arriving = arriving_light<C>(scene, R, settings.light_samples, settings.seed, rows.facets());
        rows.complete(arriving);
        light_rays = std::uint64_t{settings.light_samples} * space.facets().size();
        sources.resize(2, ExitantVector<C>::zero(0));
        if (settings.glossy == Glossy::by_rays) {
            ArrivingByLinks<C> by_links =
                arriving_by_links<C>(scene, rows, rays_of_links(space, settings.rays), settings.seed, settings.bounces, watch);
            for (std::size_t k = 2; k < by_links.radiance.size(); ++k) {
                arrives(k, by_links.radiance[k]);
                sources.push_back(R(std::move(by_links.radiance[k])));
            }
            if (settings.bounces == 0) arriving = std::move(arriving) + by_links.radiance[1];
            // All processes have found the same power, so only the first adds it.
            for (std::size_t k = 0; from_elsewhere && rows.is_first() && k < power.size(); ++k) power[k] += by_links.power[k];
            link_rays = by_links.rays;
        }
        arrives(1, arriving);
        sources[1] = R(std::move(arriving));
        power[0].emitted = power[0].caught;
    }
    const auto product = [&](const auto& field) {
        IncidentVector<C> means = T(*field(0));
        chains.add<C>(field, means);
        rows.complete(means);
        return R(std::move(means));
    };
    TracedSeries series =
        series_of<C>(product, longest_chain, Le, sources, rows, coarser, settings, watch, [&](int k, const ExitantVector<C>& term) {
            if (k > 0 || !from_elsewhere) balance.add(static_cast<std::size_t>(k), term, power);
        });
    add_up(rows, power);
    series.power = std::move(power);
    series.light_rays = light_rays;
    const auto chain_rays = static_cast<std::uint64_t>(rows.sum(static_cast<double>(chains.rays())));
    series.rays = table_rays + chain_rays + light_rays + link_rays;
    return series;
}

template <int C>
TracedSeries trace_adjoint(const Scene& scene, const PatchSpace& space, const PatchSpace& coarser, const ReflectionMatrix<C>& R,
                           const TracedSeriesSettings& settings, const Watch& watch) {
    const RayTable table(space, settings.rays, settings.seed, watch);
    const auto K = adjoint(R * TransportMatrix<C>(table));
    TracedSeries series = series_of<C>([&](const auto& field) { return K(*field(0)); }, 0,
                                       camera_importance<C>(scene, space, settings.camera_samples, settings.seed), {},
                                       RowShare(space), coarser, settings, watch, [](int, const ExitantVector<C>&) {});
    series.fine.average_over_directions();
    series.coarse.average_over_directions();
    series.rays = table.seen().size() + std::uint64_t{settings.camera_samples} * static_cast<std::uint64_t>(scene.film.crop_width) *
                                            static_cast<std::uint64_t>(scene.film.crop_height);
    return series;
}

}  // namespace

TracedSeries trace_series(const Scene& scene, const PatchSpace& space, const PatchSpace& coarser,
                          const TracedSeriesSettings& settings, const Watch& watch) {
    return trace_series(scene, RowShare(space), coarser, SceneReflection(scene, space), settings, watch);
}

TracedSeries trace_series(const Scene& scene, const RowShare& rows, const PatchSpace& coarser, const SceneReflection& reflection,
                          const TracedSeriesSettings& settings, const Watch& watch) {
    return reflection.with(
        [&]<int C>(const ReflectionMatrix<C>& R) { return trace_light<C>(scene, rows, coarser, R, settings, watch); });
}

TracedSeries trace_importance(const Scene& scene, const PatchSpace& space, const PatchSpace& coarser,
                              const SceneReflection& reflection, const TracedSeriesSettings& settings, const Watch& watch) {
    return reflection.with(
        [&]<int C>(const ReflectionMatrix<C>& R) { return trace_adjoint<C>(scene, space, coarser, R, settings, watch); });
}

}  // namespace neumann
