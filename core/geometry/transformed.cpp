#include "core/geometry/transformed.h"

#include "core/base/frame.h"

#include <utility>

namespace neumann {

namespace {

constexpr double tolerance = 1e-4;

Vec3 point(const Mat4& m, const Vec3& p) { return Vec3(m * glm::dvec4(p, 1.0)); }
Vec3 vector(const Mat4& m, const Vec3& v) { return Vec3(m * glm::dvec4(v, 0.0)); }

// The linear part over the largest of its numbers, whose products are representable.
glm::dmat3 scaled_to_one(const Mat4& m) {
    const glm::dmat3 linear(m);
    return linear / max_component({max_component(glm::abs(linear[0])), max_component(glm::abs(linear[1])),
                                   max_component(glm::abs(linear[2]))});
}

// Up to a positive factor: of a mirroring map too, normals stay on their side.
glm::dmat3 map_of_normals(const Mat4& m) { return glm::transpose(glm::inverse(scaled_to_one(m))); }

}  // namespace

TriangleMesh transformed(const TriangleMesh& mesh, const Mat4& to_world) {
    TriangleMesh result = mesh;
    for (Vec3& v : result.vertices) v = point(to_world, v);
    const glm::dmat3 of_normals = map_of_normals(to_world);
    for (Vec3& n : result.normals)
        if (const Vec3 image = of_normals * n; n != Vec3(0.0)) n = image / length_of(image);
    if (glm::determinant(scaled_to_one(to_world)) < 0.0)
        for (auto& t : result.triangles) std::swap(t[1], t[2]);
    return result;
}

Disk transformed(const Disk& disk, const Mat4& to_world) {
    const Vec3 normal = map_of_normals(to_world) * disk.normal;
    return {point(to_world, disk.center), vector(to_world, disk.u), vector(to_world, disk.v), normal / length_of(normal)};
}

std::optional<Sphere> transformed(const Sphere& sphere, const Mat4& to_world) {
    const double scale = length_of(Vec3(to_world[0]));
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j)
            if (std::abs(glm::dot(Vec3(to_world[i]) / scale, Vec3(to_world[j]) / scale) - (i == j ? 1.0 : 0.0)) > tolerance)
                return std::nullopt;
    const Frame& axes = sphere.axes;
    return Sphere{point(to_world, sphere.center), sphere.radius * scale, sphere.flip_normals,
                  Frame(vector(to_world, axes.s) / scale, vector(to_world, axes.t) / scale, vector(to_world, axes.n) / scale)};
}

std::optional<Cylinder> transformed(const Cylinder& cylinder, const Mat4& to_world) {
    const Frame& frame = cylinder.axes;
    Vec3 images[3] = {vector(to_world, frame.s), vector(to_world, frame.t), vector(to_world, frame.n)};
    const double around = length_of(images[0]), around2 = length_of(images[1]), along = length_of(images[2]);
    for (Vec3& v : images) v /= length_of(v);
    if (std::abs(around2 / around - 1.0) > tolerance || std::abs(glm::dot(images[0], images[1])) > tolerance ||
        std::abs(glm::dot(images[0], images[2])) > tolerance || std::abs(glm::dot(images[1], images[2])) > tolerance)
        return std::nullopt;
    return Cylinder{point(to_world, cylinder.base), images[2],
                    cylinder.length * along,        cylinder.radius * around,
                    cylinder.flip_normals,          Frame(images[0], images[1], images[2])};
}

std::optional<Shape> transformed(const Shape& shape, const Mat4& to_world) {
    return std::visit([&](const auto& s) -> std::optional<Shape> { return transformed(s, to_world); }, shape);
}

}  // namespace neumann
