#include "core/scene/coincident_surfaces.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

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

// Of some faces of a shape: how many others cover, and the first such shape of another material that faces the same way.
struct Covered {
    std::size_t faces = 0;
    std::optional<std::uint32_t> unlike;
};

// Adds what is seen right in front of a face.
void look_at(const Geometry& geometry, const Materials& materials, const Face& face, std::size_t looks, Covered& covered) {
    const auto& [shape, primitive] = face;
    bool is_covered = false;
    for (std::size_t k = 0; k < looks; ++k) {
        if (is_alone(geometry, geometry.place(shape, primitive), places[k])) continue;
        const SurfacePoint point = geometry.point(shape, primitive, places[k]);
        const double near = looks_from * point.error;
        SurfacePoint seen;
        if (!geometry.first_hit(point.position + point.normal * near, -point.normal, 2.0 * near, seen) || seen.shape == shape)
            continue;
        is_covered = true;
                const bool is_unlike =
            glm::dot(seen.normal, point.normal) >= 0.999 && materials.at(shape, true) != materials.at(seen.shape, true);
        if (is_unlike && !covered.unlike) covered.unlike = seen.shape;
    }
    covered.faces += is_covered;
}

}  // namespace

CoincidentSurfaces coincident_surfaces(const Geometry& geometry, const Materials& materials,
                                       const std::vector<int>& light_of_shape) {
    const auto shapes = static_cast<std::uint32_t>(geometry.shapes().size());
    const auto faces_of = [&](std::uint32_t shape) { return geometry.primitive_count(shape) / step(geometry.shapes()[shape]); };
    std::size_t faces = 0;
    for (std::uint32_t shape = 0; shape < shapes; ++shape) faces += faces_of(shape);
    const std::size_t looks = faces > many ? 1 : std::size(places);
    using Range = oneapi::tbb::blocked_range<std::uint32_t>;
    CoincidentSurfaces found;
    for (std::uint32_t shape = 0; shape < shapes; ++shape) {
        if (!has_extent(geometry.shapes()[shape])) continue;
        const Covered covered = oneapi::tbb::parallel_reduce(
            Range(0, faces_of(shape), 1024), Covered(),
            [&](const Range& range, Covered sum) {
                for (std::uint32_t i = range.begin(); i != range.end(); ++i)
                    look_at(geometry, materials, {shape, i * step(geometry.shapes()[shape])}, looks, sum);
                return sum;
            },
            [](const Covered& first, const Covered& second) {
                return Covered{first.faces + second.faces, first.unlike ? first.unlike : second.unlike};
            });
        if (light_of_shape[shape] != Emitters::none) found.lights += covered.faces;
        found.unlike += covered.unlike.has_value();
        if (covered.unlike && !found.first_unlike) found.first_unlike = {shape, *covered.unlike};
    }
    return found;
}

}  // namespace neumann
