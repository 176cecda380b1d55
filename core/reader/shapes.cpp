#include "core/reader/shapes.h"

#include "core/reader/mesh_shape.h"
#include "core/reader/properties.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

Sphere read_sphere(Properties& p, bool flip_normals) {
    const Mat4 m = p.transform("to_world");
    const Vec3 center = p.point("center").value_or(Vec3(0.0));
    const double radius = p.number("radius").value_or(1.0);
    if (radius <= 0.0) p.fail("radius", fmt::format("radius is {}, expected more than 0", radius));

    constexpr double tolerance = 1e-4;
    const double largest = max_component(glm::abs(Vec3(m[0])));
    const double scale = largest * glm::length(Vec3(m[0]) / largest);  // squares of small lengths vanish
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j)
            if (std::abs(glm::dot(Vec3(m[i]) / scale, Vec3(m[j]) / scale) - (i == j ? 1.0 : 0.0)) > tolerance)
                p.fail("to_world",
                       "to_world of shape 'sphere' makes it an ellipsoid, expected a uniform scale, rotations and translations");
    return {Vec3(m * glm::dvec4(center, 1.0)), radius * scale, flip_normals};
}

Shape read_geometry(Properties& p, const Context& context) {
    const std::string& type = p.element().attribute("type").value;
    if (type == "obj" || type == "ply") return read_mesh_shape(p, context);
    const bool flip_normals = p.boolean("flip_normals").value_or(false);
    if (type == "sphere") return read_sphere(p, flip_normals);
    const Mat4 to_world = p.transform("to_world");
    if (type == "rectangle") return make_rectangle(to_world, flip_normals);
    if (type == "cube") return make_cube(to_world, flip_normals);
    return make_disk(to_world, flip_normals);
}

}  // namespace

ReadShape read_shape(const Element& e, const Context& context) {
    static const std::vector<std::string> types = {"cube", "disk", "obj", "ply", "rectangle", "sphere"};
    if (std::find(types.begin(), types.end(), e.attribute("type").value) == types.end()) fail_type(e, types);
    Properties p(e, context.objects);
    ReadShape result;
    result.shape = read_geometry(p, context);
    const std::vector<const Element*> bsdfs = p.nested("bsdf"), emitters = p.nested("emitter");
    p.finish();
    if (!bsdfs.empty()) result.bsdf = bsdfs.front();
    if (!emitters.empty()) result.emitter = emitters.front();
    return result;
}

}  // namespace neumann::reader
