#include "core/scene/scene.h"

namespace neumann {

Scene make_scene(SceneParts parts) {
    Geometry geometry(std::move(parts.shapes));
    Materials materials(std::move(parts.bsdfs), std::move(parts.sides_of_shape));
    Emitters emitters(geometry, std::move(parts.lights), std::move(parts.light_of_shape));
    Warnings warnings = std::move(parts.warnings);
    warnings.add("degenerate triangle or shape without extent left out", geometry.degenerate_count());
    warnings.add("light without area gives off nothing", emitters.without_area());
    if (geometry.shapes().empty()) warnings.add("the scene has no surfaces");
    if (emitters.empty()) warnings.add("the scene has no light");
    if (max_component(materials.largest_albedo()) > 1.0)
        warnings.add("reflectance above 1: a surface gives back more light than it receives");
    const Perspective camera(parts.camera, parts.film);
    return {std::move(geometry), std::move(materials), std::move(emitters), camera, parts.film,
            parts.bounces, parts.sampler, std::move(parts.hash), std::move(warnings)};
}

}  // namespace neumann
