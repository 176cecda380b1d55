#include "operators/methods/preparation.h"

#include "core/base/error.h"
#include "operators/correction/approximation.h"
#include "operators/guide/guide.h"
#include "operators/pictures/field_goal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// A scene of boxes and a limit of a second are no reason to do without.
constexpr double part_of_time = 1.0 / 3.0, short_preparation = 0.5;
double longest_preparation(double seconds) { return std::max(part_of_time * seconds, short_preparation); }
// The rays of a guide's tables can be fewer, down to one in a cell.
constexpr std::uint32_t fewest_of_table = CellDistribution::cells;

struct Count {
    double faces = 0.0, sides = 0.0;  // sides: that reflect or shine
};
Count count_of(const Scene& scene) {
    Count count;
    for (std::uint32_t shape = 0; shape < scene.geometry.shapes().size(); ++shape) {
        const double faces = scene.geometry.primitive_count(shape);
        const bool front = scene.materials.at(shape, true) || scene.emitters.is_emitter(shape);
        count.faces += faces;
        count.sides += faces * ((front ? 1.0 : 0.0) + (scene.materials.at(shape, false) ? 1.0 : 0.0));
    }
    return count;
}

// `patches` are divided among the sides; a side has one patch at least.
double facets_of(const Count& count, double patches) {
    return std::max(patches * count.sides / std::max(count.faces, 1.0), count.sides);
}

double rays_of(const method::Guided& guided, const Count& count) {
    const GuideSettings defaults;
    const double each = defaults.field_rays + TracedSeriesSettings{}.light_samples + guided.directions.value_or(defaults.rays);
    return each * facets_of(count, static_cast<double>(guided.patches.value_or(defaults.patches)));
}
double rays_of(const method::Corrected& corrected, const Count& count) {
    const ApproximationSettings defaults;
    const double rays = corrected.directions.value_or(defaults.rays), each = 2.0 * rays + CellDistribution::cells;
    return each * facets_of(count, static_cast<double>(corrected.patches.value_or(defaults.patches)));
}
template <HasFields M>
double rays_of(const M&, const Count& count) {
    const FieldSettings first = first_of_search(FieldSettings(), FieldSettings());
    return static_cast<double>(first.replicates) * (static_cast<double>(first.rays) + first.light_samples) *
           facets_of(count, static_cast<double>(first.patching.patches));
}
template <class M>
requires(!HasFields<M>) double rays_of(const M&, const Count&) { return 0.0; }

}  // namespace

Preparation preparation_of(const Method& method, const Scene& scene, const Pilot& pilot) {
    const Count count = count_of(scene);
    const double rays = std::visit([&](const auto& m) { return rays_of(m, count); }, method);
    return {count.faces, rays, rays * pilot.seconds_per_ray()};
}

double cut_off_preparation(double seconds) { return 1.5 * longest_preparation(seconds); }

Method prepared_in_time(double seconds, const Method& method, const Scene& scene, const Pilot& pilot) {
    const double longest = longest_preparation(seconds);
    const auto fits = [&](const Method& m) { return preparation_of(m, scene, pilot).seconds <= longest; };
    if (fits(method)) return method;
    const auto* const guided = std::get_if<method::Guided>(&method);
    for (std::uint32_t rays = GuideSettings().rays / 2; guided && !guided->directions && rays >= fewest_of_table; rays /= 2) {
        method::Guided coarser = *guided;
        coarser.directions = rays;
        if (fits(coarser)) return coarser;
    }
    const Preparation preparation = preparation_of(method, scene, pilot);
    throw InputError(fmt::format(
        "--method {}: {}, and a third of {:.3g} s at most may go into that; take --time {:.0f}, --spp, or --method walk",
        name_of(method), describe(preparation), seconds, std::ceil(preparation.seconds / part_of_time)));
}

std::string describe(const Preparation& preparation) {
    return fmt::format("its fields on {:.0f} faces would take about {:.{}f} s to make", preparation.faces, preparation.seconds,
                       preparation.seconds < 9.95 ? 1 : 0);
}

}  // namespace neumann
