#include "core/reader/shapes.h"

#include "core/base/frame.h"
#include "core/reader/mesh_shape.h"
#include "core/reader/properties.h"
#include "core/reader/textures.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

constexpr double tolerance = 1e-4;

// Squares of small lengths vanish.
double length_of(const Vec3& v) {
    const double largest = max_component(glm::abs(v));
    return largest * glm::length(v / largest);
}

double read_radius(Properties& p) {
    const double radius = p.number("radius").value_or(1.0);
    if (radius <= 0.0) p.fail("radius", fmt::format("radius is {}, expected more than 0", radius));
    return radius;
}

Sphere read_sphere(Properties& p, bool flip_normals) {
    const Mat4 m = p.transform("to_world");
    const Vec3 center = p.point("center").value_or(Vec3(0.0));
    const double radius = read_radius(p), scale = length_of(Vec3(m[0]));
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j)
            if (std::abs(glm::dot(Vec3(m[i]) / scale, Vec3(m[j]) / scale) - (i == j ? 1.0 : 0.0)) > tolerance)
                p.fail("to_world",
                       "to_world of shape 'sphere' makes it an ellipsoid, expected a uniform scale, rotations and translations");
    return {Vec3(m * glm::dvec4(center, 1.0)), radius * scale, flip_normals,
            Frame(Vec3(m[0]) / scale, Vec3(m[1]) / scale, Vec3(m[2]) / scale)};
}

Cylinder read_cylinder(Properties& p, bool flip_normals) {
    const Mat4 m = p.transform("to_world");
    const Vec3 p0 = p.point("p0").value_or(Vec3(0.0)), p1 = p.point("p1").value_or(Vec3(0.0, 0.0, 1.0));
    const double radius = read_radius(p);
    if (p0 == p1) p.fail("p1", "p0 and p1 of shape 'cylinder' are the same point");

    const Frame frame((p1 - p0) / length_of(p1 - p0));
    Vec3 images[3] = {Vec3(m * glm::dvec4(frame.s, 0.0)), Vec3(m * glm::dvec4(frame.t, 0.0)), Vec3(m * glm::dvec4(frame.n, 0.0))};
    const double around = length_of(images[0]), around2 = length_of(images[1]), along = length_of(images[2]);
    for (Vec3& v : images) v /= length_of(v);
    if (std::abs(around2 / around - 1.0) > tolerance || std::abs(glm::dot(images[0], images[1])) > tolerance ||
        std::abs(glm::dot(images[0], images[2])) > tolerance || std::abs(glm::dot(images[1], images[2])) > tolerance)
        p.fail("to_world",
               "to_world of shape 'cylinder' makes it elliptic or oblique, expected the same scale all around the axis, rotations "
               "and translations");
    return {Vec3(m * glm::dvec4(p0, 1.0)),         images[2], length_of(p1 - p0) * along, radius * around, flip_normals,
            Frame(images[0], images[1], images[2])};
}

Shape read_geometry(Properties& p, const Context& context) {
    const std::string& type = p.element().attribute("type").value;
    if (type == "obj" || type == "ply") return read_mesh_shape(p, context);
    const bool flip_normals = p.boolean("flip_normals").value_or(false);
    if (type == "sphere") return read_sphere(p, flip_normals);
    if (type == "cylinder") return read_cylinder(p, flip_normals);
    const Mat4 to_world = p.transform("to_world");
    if (type == "rectangle") return make_rectangle(to_world, flip_normals);
    if (type == "cube") return make_cube(to_world, flip_normals);
    return make_disk(to_world, flip_normals);
}

// What its textures ask for has to be there.
void check_attributes(const Properties& p, const Shape& shape, const Context& context) {
    const auto* mesh = std::get_if<TriangleMesh>(&shape);
    for (const auto& [name, e] : mesh_attributes_of(p.element(), context.objects))
        if (!mesh || !mesh->attribute(name))
            throw InputError(e->attribute("value").place,
                             fmt::format("{} at {} has no mesh attribute '{}'", p.title(), to_string(p.element().place), name));
    if (!mesh) return;
    for (const MeshAttribute& a : mesh->attributes)
        for (const auto& v : a.values) {
            const Rgb value(v[0], v[1], v[2]);
            TextureStore::Range& range = context.textures.attributes.try_emplace(a.name, value, value).first->second;
            range = {glm::min(range.smallest, value), glm::max(range.largest, value)};
        }
}

}  // namespace

ReadShape read_shape(const Element& e, const Context& context) {
    static const std::vector<std::string> types = {"cube", "cylinder", "disk", "obj", "ply", "rectangle", "sphere"};
    if (std::find(types.begin(), types.end(), e.attribute("type").value) == types.end()) fail_type(e, types);
    Properties p(e, context.objects);
    ReadShape result;
    result.shape = read_geometry(p, context);
    check_attributes(p, result.shape, context);
    const std::vector<const Element*> bsdfs = p.nested("bsdf"), emitters = p.nested("emitter");
    p.finish();
    if (!bsdfs.empty()) result.bsdf = bsdfs.front();
    if (!emitters.empty()) result.emitter = emitters.front();
    return result;
}

}  // namespace neumann::reader
