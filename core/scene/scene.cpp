#include "core/scene/scene.h"

#include "core/scene/coincident_surfaces.h"
#include "core/scene/measured_laws.h"

#include <fmt/format.h>

namespace neumann {

namespace {

// " (bsdf 'principled' of shape 'obj', room.xml:7:5)".
std::string where(const std::vector<Origin>& origins, std::uint32_t shape) {
    if (shape >= origins.size()) return "";
    const Origin& origin = origins[shape];
    return fmt::format(" ({} of {}, {})", origin.bsdf, origin.shape, to_string(origin.place));
}

void warn_of_laws(const MeasuredLaws& laws, const std::vector<Origin>& origins, Warnings& warnings) {
    if (laws.materials == 0) return;
    warnings.add(
        fmt::format("{} material{} neither energy conservation nor reciprocity; the largest albedo is {:.3f}{} and the largest "
                    "reciprocity defect "
                    "{:.2g}{}",
                    laws.materials, laws.materials == 1 ? " promises" : "s promise", laws.largest_albedo,
                    where(origins, laws.brightest), laws.reciprocity_defect, where(origins, laws.least_reciprocal)));
}

void warn_of_coincidence(const CoincidentSurfaces& found, const std::vector<Origin>& origins, Warnings& warnings) {
    warnings.add(
        "part of a light lies in the same place as another shape: which one is seen is chance, and its light may count twice",
        found.lights);
    if (!found.first_unlike) return;
    const auto name = [&](std::uint32_t shape) {
        return shape < origins.size() ? fmt::format("{} ({})", origins[shape].shape, to_string(origins[shape].place))
                                      : fmt::format("shape {}", shape);
    };
    warnings.add(fmt::format(
        "{} and {} face the same way in the same place and are made of different materials: which one is seen "
        "is chance{}",
        name(found.first_unlike->first), name(found.first_unlike->second), found.unlike > 2 ? "; others do as well" : ""));
}

}  // namespace

Scene make_scene(SceneParts parts) {
    Geometry geometry(std::move(parts.shapes));
    Materials materials(std::move(parts.bsdfs), std::move(parts.sides_of_shape), geometry.shared_shapes());
    Warnings warnings = std::move(parts.warnings);
    warn_of_coincidence(coincident_surfaces(geometry, materials, parts.lights.of_shape), parts.origins, warnings);
    Emitters emitters(geometry, std::move(parts.lights));
    warnings.add("degenerate triangle or shape without extent left out", geometry.degenerate_count());
    warnings.add("light without area gives off nothing", emitters.without_area());
    if (geometry.shapes().empty()) warnings.add("the scene has no surfaces");
    if (emitters.empty()) warnings.add("the scene has no light");
    if (max_component(materials.largest_basic_albedo()) > 1.0)
        warnings.add("reflectance above 1: a surface gives back more light than it receives");
    warn_of_laws(measure_laws(geometry, materials), parts.origins, warnings);
    const Sensor camera(parts.camera, parts.film);
    return {std::move(geometry),
            std::move(materials),
            std::move(emitters),
            camera,
            parts.film,
            parts.bounces,
            parts.sampler,
            parts.hide_emitters,
            std::move(parts.hash),
            std::move(parts.origins),
            std::move(warnings)};
}

}  // namespace neumann
