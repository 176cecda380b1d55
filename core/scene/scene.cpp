#include "core/scene/scene.h"

namespace neumann {

namespace {

// Parts of lights that are not seen from right in front of them, because another shape lies in the same place: whether such a light
// is hit or what covers it is chance, and light sampling counts both.
std::size_t covered_lights(const Geometry& geometry, const std::vector<int>& light_of_shape) {
    std::size_t count = 0;
    for (std::uint32_t shape = 0; shape < light_of_shape.size(); ++shape) {
        if (light_of_shape[shape] == Emitters::none || geometry.area(shape) == 0.0) continue;
        for (std::uint32_t primitive = 0; primitive < geometry.primitive_count(shape); ++primitive) {
            const SurfacePoint point = geometry.point(shape, primitive, Vec2(0.5));
            SurfacePoint seen;
            const double near = 4.0 * point.error;
            if (geometry.first_hit(point.position + point.normal * near, -point.normal, 2.0 * near, seen))
                count += seen.shape != shape;
        }
    }
    return count;
}

}  // namespace

Scene make_scene(SceneParts parts) {
    Geometry geometry(std::move(parts.shapes));
    Materials materials(std::move(parts.bsdfs), std::move(parts.sides_of_shape), geometry.shared_shapes());
    Warnings warnings = std::move(parts.warnings);
    warnings.add(
        "part of a light lies in the same place as another shape: which one is seen is chance, and its light may count twice",
        covered_lights(geometry, parts.lights.of_shape));
    Emitters emitters(geometry, std::move(parts.lights));
    warnings.add("degenerate triangle or shape without extent left out", geometry.degenerate_count());
    warnings.add("light without area gives off nothing", emitters.without_area());
    if (geometry.shapes().empty()) warnings.add("the scene has no surfaces");
    if (emitters.empty()) warnings.add("the scene has no light");
    if (max_component(materials.largest_basic_albedo()) > 1.0)
        warnings.add("reflectance above 1: a surface gives back more light than it receives");
    const Sensor camera(parts.camera, parts.film);
    return {std::move(geometry), std::move(materials),  std::move(emitters),     camera, parts.film, parts.bounces, parts.sampler,
            parts.hide_emitters, std::move(parts.hash), std::move(parts.origins), std::move(warnings)};
}

}  // namespace neumann
