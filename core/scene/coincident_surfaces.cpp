#include "core/scene/coincident_surfaces.h"

namespace neumann {

namespace {

// Points away from edges and diagonals, where rays could hit neighbours.
constexpr Vec2 places[] = {Vec2(0.5), Vec2(0.21, 0.34), Vec2(0.72, 0.13), Vec2(0.37, 0.81)};
constexpr double looks_from = 4.0;         // in errors of the point
constexpr std::size_t many = 100'000;      // with more primitives, only one point of each is tested
constexpr std::uint32_t of_instance = 64;  // about as many triangles of an instance are tested

std::uint32_t step(const Shape& shape) {
    const auto* instance = std::get_if<MeshInstance>(&shape);
    return instance ? static_cast<std::uint32_t>(instance->mesh().triangles.size()) / of_instance + 1 : 1;
}

// Whether nothing but the triangle itself is where the ray looks, by Embree alone: what else is close to each of the triangles of a
// large scene takes long to find out, and most are by themselves.
bool is_alone(const Geometry& geometry, const Geometry::Place& place, const Vec2& uv) {
    if (!place.triangle || !geometry.giants().empty()) return false;
    const Triangle& t = *place.triangle;
    const Vec2 weights = uniform_triangle(uv);
    const double near = looks_from * t.error();
    const Vec3 from = t.at(weights.x, weights.y, place.edges) + t.normal() * near;
    const Face own[] = {{place.shape, place.primitive}};
    RayCaster::Hit hit;
    return !geometry.caster().intersect(from, -t.normal(), 2.0 * near, own, hit);
}

}  // namespace

CoincidentSurfaces coincident_surfaces(const Geometry& geometry, const Materials& materials,
                                       const std::vector<int>& light_of_shape) {
    const auto shapes = static_cast<std::uint32_t>(geometry.shapes().size());
    std::size_t primitives = 0;
    for (std::uint32_t shape = 0; shape < shapes; ++shape)
        primitives += geometry.primitive_count(shape) / step(geometry.shapes()[shape]);
    const std::size_t looks = primitives > many ? 1 : std::size(places);
    CoincidentSurfaces found;
    for (std::uint32_t shape = 0; shape < shapes; ++shape) {
        if (!has_extent(geometry.shapes()[shape])) continue;
        bool is_unlike = false;
        for (std::uint32_t primitive = 0; primitive < geometry.primitive_count(shape);
             primitive += step(geometry.shapes()[shape])) {
            bool is_covered = false;
            for (std::size_t k = 0; k < looks; ++k) {
                if (is_alone(geometry, geometry.place(shape, primitive), places[k])) continue;
                const SurfacePoint point = geometry.point(shape, primitive, places[k]);
                const double near = looks_from * point.error;
                SurfacePoint seen;
                if (!geometry.first_hit(point.position + point.normal * near, -point.normal, 2.0 * near, seen) ||
                    seen.shape == shape)
                    continue;
                is_covered = true;
                if (glm::dot(seen.normal, point.normal) < 0.999 || materials.at(shape, true) == materials.at(seen.shape, true))
                    continue;
                is_unlike = true;
                if (!found.first_unlike) found.first_unlike = {shape, seen.shape};
            }
            found.lights += is_covered && light_of_shape[shape] != Emitters::none;
        }
        found.unlike += is_unlike;
    }
    return found;
}

}  // namespace neumann
