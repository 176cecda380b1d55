#include "operators/methods/preparation.h"

#include "core/base/error.h"
#include "operators/correction/approximation.h"
#include "operators/guide/guide.h"
#include "operators/patches/shape_areas.h"
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

struct ShapeSides {
    double share = 0.0;  // of the area
    double sides = 0.0;  // that reflect or shine
};
struct Count {
    std::vector<ShapeSides> shapes;
    double faces = 0.0;
};
// To join a face to its neighbours takes about as long as so many rays.
constexpr double rays_of_face = 0.3;
Count count_of(const Scene& scene) {
    Count count;
    const std::vector<ShapeArea> areas = shape_areas(scene.geometry);
    const double area = sum_of_areas(areas);
    for (std::uint32_t shape = 0; shape < areas.size(); ++shape) {
        const bool front = scene.materials.at(shape, true) || scene.emitters.is_emitter(shape);
        count.faces += scene.geometry.primitive_count(shape);
        count.shapes.push_back(
            {area > 0.0 ? areas[shape].area / area : 0.0, (front ? 1.0 : 0.0) + (scene.materials.at(shape, false) ? 1.0 : 0.0)});
    }
    return count;
}

double facets_of(const Count& count, double patches) {
    double facets = 0.0;
    for (const ShapeSides& shape : count.shapes)
        if (shape.share > 0.0) facets += shape.sides * std::max(patches * shape.share, 1.0);
    return facets;
}

struct Needs {
    double facets, rays;
};
Needs needs_of(const method::Guided& guided, const Count& count) {
    const GuideSettings defaults;
    const double each = defaults.field_rays + TracedSeriesSettings{}.light_samples + guided.directions.value_or(defaults.rays);
    const double facets = facets_of(count, static_cast<double>(guided.patches.value_or(defaults.patches)));
    return {facets, each * facets};
}
Needs needs_of(const method::Corrected& corrected, const Count& count) {
    const ApproximationSettings defaults;
    const double rays = corrected.directions.value_or(defaults.rays),
                 each = 2.0 * rays + CellDistribution::cells + FieldRaster::rays_of_facet;
    const double facets = facets_of(count, static_cast<double>(corrected.patches.value_or(defaults.patches)));
    return {facets, each * facets};
}
template <HasFields M>
Needs needs_of(const M&, const Count& count) {
    const FieldSettings first = first_of_search(FieldSettings(), FieldSettings());
    const double facets = facets_of(count, static_cast<double>(first.patching.patches));
    return {facets, static_cast<double>(first.replicates) * (static_cast<double>(first.rays) + first.light_samples) * facets};
}
template <class M>
requires(!HasFields<M>) Needs needs_of(const M&, const Count&) { return {0.0, 0.0}; }

Preparation preparation_of(const Method& method, const Count& count, const Pilot& pilot) {
    const Needs needs = std::visit([&](const auto& m) { return needs_of(m, count); }, method);
    if (needs.facets == 0.0) return {};
    return {needs.facets, needs.rays, (needs.rays + rays_of_face * count.faces) * pilot.seconds_per_ray()};
}

}  // namespace

Preparation preparation_of(const Method& method, const Scene& scene, const Pilot& pilot) {
    return preparation_of(method, count_of(scene), pilot);
}

double cut_off_preparation(double seconds) { return 1.5 * longest_preparation(seconds); }

Method prepared_in_time(double seconds, const Method& method, const Scene& scene, const Pilot& pilot) {
    const double longest = longest_preparation(seconds);
    const Count count = count_of(scene);
    const auto fits = [&](const Method& m) { return preparation_of(m, count, pilot).seconds <= longest; };
    if (fits(method)) return method;
    const auto* const guided = std::get_if<method::Guided>(&method);
    for (std::uint32_t rays = GuideSettings().rays / 2; guided && !guided->directions && rays >= fewest_of_table; rays /= 2) {
        method::Guided coarser = *guided;
        coarser.directions = rays;
        if (fits(coarser)) return coarser;
    }
    const Preparation preparation = preparation_of(method, count, pilot);
    throw InputError(fmt::format(
        "--method {}: {}, and a third of {:.3g} s at most may go into that; take --time {:.0f}, --spp, or --method walk",
        name_of(method), describe(preparation), seconds, std::ceil(preparation.seconds / part_of_time)));
}

std::string describe(const Preparation& preparation) {
    return fmt::format("its fields on {:.0f} patches would take about {:.{}f} s to make", preparation.facets, preparation.seconds,
                       preparation.seconds < 9.95 ? 1 : 0);
}

}  // namespace neumann
