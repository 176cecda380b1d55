#include "operators/render/methods/preparation.h"

#include "core/base/error.h"
#include "operators/fields/patches/shape_areas.h"
#include "operators/render/from_fields/field_goal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// short_preparation is always allowed, so that a scene of boxes with a limit of one second can be prepared.
constexpr double part_of_time = 1.0 / 3.0, short_preparation = 0.5;
double longest_preparation(double seconds) { return std::max(part_of_time * seconds, short_preparation); }

// A ray for fields or tables takes less time than one of the pilot's walks: it needs no shading and no search for close
// surfaces, and starts where others do. The time of a face is that of joining it to its neighbours
// (tests/bench/bench_mesh.py compares forecasts with measured times).
constexpr double price_of_ray = 0.6, seconds_of_face = 3e-7;

using Shapes = std::vector<Preparations::ShapeSides>;
// `least`: the least number of patches of a shape.
double facets_of(const Shapes& shapes, double patches, double least = 1.0) {
    double facets = 0.0;
    for (const Preparations::ShapeSides& shape : shapes)
        if (shape.share > 0.0) facets += shape.sides * std::max(patches * shape.share, least);
    return facets;
}

struct Needs {
    double facets = 0.0, rays = 0.0;
};
template <MakesPaths M>
Needs needs_of(const M& m, const Shapes& shapes) {
    const std::optional<method::FieldNeeds> needs = m.needs();
    if (!needs) return {};
    const double facets = facets_of(shapes, static_cast<double>(needs->patches));
    return {facets, needs->rays_of_facet * facets};
}
template <HasFields M>
Needs needs_of(const M&, const Shapes& shapes) {
    const FieldSettings first = first_of_search(FieldSettings(), FieldSettings());
    const double facets = facets_of(shapes, static_cast<double>(first.patching.patches), 4.0);  // as Patching::compared
    return {facets, static_cast<double>(first.replicates) * (static_cast<double>(first.rays) + first.light_samples) * facets};
}
// The method, followed by ever coarser versions of it in the options that the user has left open.
std::vector<Method> less_and_less_fine(const Method& method) {
    std::vector<Method> all{method};
    std::visit(
        [&](const auto& m) {
            if constexpr (requires { m.coarser(); })
                for (const auto& coarser : m.coarser()) all.emplace_back(coarser);
        },
        method);
    return all;
}

}  // namespace

Preparations::Preparations(const Scene& scene, const Pilot& pilot) : seconds_per_ray_(pilot.seconds_per_ray()) {
    const std::vector<ShapeArea> areas = shape_areas(scene.geometry);
    const double area = sum_of_areas(areas);
    for (std::uint32_t shape = 0; shape < areas.size(); ++shape) {
        const bool front = scene.materials.at(shape, true) || scene.emitters.is_emitter(shape);
        faces_ += scene.geometry.primitive_count(shape);
        shapes_.push_back(
            {area > 0.0 ? areas[shape].area / area : 0.0, (front ? 1.0 : 0.0) + (scene.materials.at(shape, false) ? 1.0 : 0.0)});
    }
}

Preparation Preparations::of(const Method& method) const {
    const Needs needs = std::visit([&](const auto& m) { return needs_of(m, shapes_); }, method);
    if (needs.facets == 0.0) return {};
    return {needs.facets, needs.rays, price_of_ray * needs.rays * seconds_per_ray_ + seconds_of_face * faces_};
}

bool prepares_fields(const Method& method) {
    return std::visit(
        []<class M>(const M& m) {
            if constexpr (MakesPaths<M>) return m.needs().has_value();
            return false;
        },
        method);
}

double cut_off_preparation(double seconds) { return 1.5 * longest_preparation(seconds); }

std::optional<Method> Preparations::fitting(double seconds, const Method& method) const {
    for (const Method& m : less_and_less_fine(method))
        if (of(m).seconds <= seconds) return m;
    return std::nullopt;
}

Method Preparations::in_time(double seconds, const Method& method) const {
    if (const auto fits = fitting(longest_preparation(seconds), method)) return *fits;
    const Preparation preparation = of(method);
    throw InputError(
        fmt::format("{}: {}, and a third of {:.3g} s at most may go into that; take {:.0f} s, a number of samples, or walk",
                    name_of(method), describe(preparation), seconds, std::ceil(preparation.seconds / part_of_time)));
}

std::string describe(const Preparation& preparation) {
    return fmt::format("its fields on {:.0f} patches would take about {:.{}f} s to make", preparation.facets, preparation.seconds,
                       preparation.seconds < 9.95 ? 1 : 0);
}

}  // namespace neumann
