#include "core/scene/coincident_surfaces.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>

namespace neumann {

namespace {

// Points away from edges and diagonals, where rays could hit neighbours.
constexpr Vec2 places[] = {Vec2(0.5), Vec2(0.21, 0.34), Vec2(0.72, 0.13), Vec2(0.37, 0.81)};
constexpr double looks_from = 4.0;         // in units of the point's error
constexpr std::size_t many = 100'000;      // with more primitives, only one point of each is tested
constexpr std::uint32_t of_instance = 64;  // about as many triangles of an instance are tested
constexpr double boxes_at_once = 64.0;

double area_of_box(const Bounds& box) {
    const Vec3 d = box.high - box.low;
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

// About the number of triangles' boxes that a ray through the mesh meets, which the time depends on: a few in a smooth
// mesh; a part of all, in a fan of needles or if all triangles lie in one place.
double boxes_met(const TriangleMesh& mesh) {
    Bounds all;
    double sum = 0.0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Bounds box = corners_of(mesh, i).bounds();
        all.add(box);
        sum += area_of_box(box);
    }
    return mesh.triangles.empty() ? 0.0 : sum / area_of_box(all);
}

// Every how many faces of a shape one is tested: if rays meet many faces, testing all of them would take time with the
// square of their number.
std::uint32_t step(const Shape& shape) {
    if (const auto* instance = std::get_if<MeshInstance>(&shape))
        return static_cast<std::uint32_t>(instance->mesh().triangles.size()) / of_instance + 1;
    const auto* mesh = std::get_if<TriangleMesh>(&shape);
    return mesh ? static_cast<std::uint32_t>(boxes_met(*mesh) / boxes_at_once) + 1 : 1;
}

// How many of some faces of a shape are covered by others, and the first such shape of another material that faces the same way.
struct Covered {
    std::size_t faces = 0;
    std::optional<std::uint32_t> unlike;
};

// Adds what is seen right in front of a face.
void look_at(const Geometry& geometry, const Materials& materials, const Face& face, std::size_t looks, Covered& covered) {
    const auto& [shape, primitive] = face;
    bool is_covered = false;
    for (std::size_t k = 0; k < looks; ++k) {
        const SurfacePoint point = geometry.bare_point(geometry.primitive_ref(shape, primitive), places[k]);
        const SurfacePoint seen = geometry.seen_in_place_of(point, looks_from);
        if (seen.shape == shape) continue;
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
    std::vector<std::uint32_t> steps(shapes);
    oneapi::tbb::parallel_for(std::uint32_t{0}, shapes,
                              [&](std::uint32_t shape) { steps[shape] = step(geometry.shapes()[shape]); });
    const auto faces_of = [&](std::uint32_t shape) { return geometry.primitive_count(shape) / steps[shape]; };
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
                    look_at(geometry, materials, {shape, i * steps[shape]}, looks, sum);
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
