#include "core/geometry/transformed.h"

#include "core/base/frame.h"
#include "core/geometry/affine.h"

#include <utility>

namespace neumann {

namespace {

constexpr double tolerance = 1e-4;

}  // namespace

TriangleMesh transformed(const TriangleMesh& mesh, const Mat4& to_world) {
    TriangleMesh result = mesh;
    for (Vec3& v : result.vertices) v = transformed_point(to_world, v);
    const glm::dmat3 of_normals = map_of_normals(to_world);
    for (Vec3& n : result.normals)
        if (const Vec3 image = of_normals * n; n != Vec3(0.0)) n = image / length_of(image);
    if (is_mirroring(to_world))
        for (auto& t : result.triangles) std::swap(t[1], t[2]);
    return result;
}

Disk transformed(const Disk& disk, const Mat4& to_world) {
    const Vec3 normal = map_of_normals(to_world) * disk.normal;
    return {transformed_point(to_world, disk.center), transformed_vector(to_world, disk.u), transformed_vector(to_world, disk.v),
            normal / length_of(normal)};
}

std::optional<Sphere> transformed(const Sphere& sphere, const Mat4& to_world) {
    const double scale = length_of(Vec3(to_world[0]));
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j)
            if (std::abs(glm::dot(Vec3(to_world[i]) / scale, Vec3(to_world[j]) / scale) - (i == j ? 1.0 : 0.0)) > tolerance)
                return std::nullopt;
    const Frame& axes = sphere.axes;
    return Sphere{transformed_point(to_world, sphere.center), sphere.radius * scale, sphere.flip_normals,
                  Frame(transformed_vector(to_world, axes.s) / scale, transformed_vector(to_world, axes.t) / scale,
                        transformed_vector(to_world, axes.n) / scale)};
}

std::optional<Cylinder> transformed(const Cylinder& cylinder, const Mat4& to_world) {
    const Frame& frame = cylinder.axes;
    Vec3 images[3] = {transformed_vector(to_world, frame.s), transformed_vector(to_world, frame.t),
                      transformed_vector(to_world, frame.n)};
    const double around = length_of(images[0]), around2 = length_of(images[1]), along = length_of(images[2]);
    for (Vec3& v : images) v /= length_of(v);
    if (std::abs(around2 / around - 1.0) > tolerance || std::abs(glm::dot(images[0], images[1])) > tolerance ||
        std::abs(glm::dot(images[0], images[2])) > tolerance || std::abs(glm::dot(images[1], images[2])) > tolerance)
        return std::nullopt;
    return Cylinder{transformed_point(to_world, cylinder.base),
                    images[2],
                    cylinder.length * along,
                    cylinder.radius * around,
                    cylinder.flip_normals,
                    Frame(images[0], images[1], images[2])};
}

MeshInstance transformed(const MeshInstance& instance, const Mat4& to_world) {
    return {instance.shared(), to_world * instance.to_world()};
}

std::optional<Shape> transformed(const Shape& shape, const Mat4& to_world) {
    return std::visit([&](const auto& s) -> std::optional<Shape> { return transformed(s, to_world); }, shape);
}

}  // namespace neumann
