#include "core/reader/plugins/shape_plugins.h"

#include "core/geometry/transformed.h"
#include "core/reader/plugins/curve_shape.h"
#include "core/reader/plugins/mesh_shape.h"
#include "core/reader/plugins/textures.h"
#include "core/reader/xml/properties.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

double read_radius(Properties& p) {
    const double radius = p.number("radius").value_or(1.0);
    if (radius > 0.0) return radius;
    p.complain("radius", fmt::format("radius is {}, expected more than 0", radius));
    return 1.0;
}

Sphere read_sphere(Properties& p, bool flip_normals) {
    const Mat4 to_world = p.transform("to_world");
    const Vec3 center = p.point("center").value_or(Vec3(0.0));
    const std::optional<Sphere> sphere = transformed(Sphere{center, read_radius(p), flip_normals}, to_world);
    if (!sphere)
        p.complain("to_world",
                   "to_world of shape 'sphere' makes it an ellipsoid, expected a uniform scale, rotations and translations");
    return sphere.value_or(Sphere());
}

Cylinder read_cylinder(Properties& p, bool flip_normals) {
    const Mat4 to_world = p.transform("to_world");
    const Vec3 p0 = p.point("p0").value_or(Vec3(0.0)), p1 = p.point("p1").value_or(Vec3(0.0, 0.0, 1.0));
    const double radius = read_radius(p), length = length_of(p1 - p0);
    if (p0 == p1) {
        p.complain("p1", "p0 and p1 of shape 'cylinder' are the same point", {"p0"});
        return {};
    }
    const std::optional<Cylinder> cylinder = transformed(Cylinder{p0, (p1 - p0) / length, length, radius, flip_normals}, to_world);
    if (!cylinder)
        p.complain("to_world",
                   "to_world of shape 'cylinder' makes it elliptic or oblique, expected the same scale all around the axis, "
                   "rotations and translations",
                   {"p0", "p1"});
    return cylinder.value_or(Cylinder());
}

Shape read_geometry(Properties& p, const Context& context) {
    const std::string& type = p.element().attribute("type").value;
    if (type == "obj" || type == "ply" || type == "serialized") return read_mesh_shape(p, context);
    if (type == "bsplinecurve" || type == "linearcurve") return read_curve_shape(p, context);
    const bool flip_normals = p.boolean("flip_normals").value_or(false);
    if (type == "sphere") return read_sphere(p, flip_normals);
    if (type == "cylinder") return read_cylinder(p, flip_normals);
    const Mat4 to_world = p.transform("to_world");
    if (type == "rectangle") return make_rectangle(to_world, flip_normals);
    if (type == "cube") return make_cube(to_world, flip_normals);
    return make_disk(to_world, flip_normals);
}

// Throws InputError if a shape lacks mesh attributes that its textures need.
void check_attributes(const Properties& p, const Shape& shape, const Context& context) {
    const auto* mesh = std::get_if<TriangleMesh>(&shape);
    for (const auto& [name, e] : mesh_attributes_of(p.element(), context.objects))
        if (!mesh || !mesh->attribute(name))
            context.problems().add(
                InputError(e->attribute("value").place,
                           fmt::format("{} at {} has no mesh attribute '{}'", p.title(), to_string(p.element().place), name)),
                p.element().place);
    if (!mesh) return;
    for (const MeshAttribute& a : mesh->attributes)
        for (const auto& v : a.values) {
            const Rgb value(v[0], v[1], v[2]);
            context.textures.widen(a.name, {value, value});
        }
}

}  // namespace

ReadShape read_shape(const Element& e, const Context& context) {
    static const std::vector<std::string> types = {"bsplinecurve", "cube",       "cylinder", "disk", "instance",
                                                   "linearcurve",  "merge",      "obj",      "ply",  "rectangle",
                                                   "serialized",   "shapegroup", "sphere"};
    if (std::find(types.begin(), types.end(), e.attribute("type").value) == types.end()) fail_type(e, types, "left out");
    Properties p(e, context.objects);
    ReadShape result;
    result.element = &e;
    const std::vector<const Element*> bsdfs = p.nested("bsdf"), emitters = p.nested("emitter"), sensors = p.nested("sensor");
    if (!bsdfs.empty()) result.bsdf = bsdfs.front();
    if (!emitters.empty()) result.emitter = emitters.front();
    if (!sensors.empty()) result.sensor = sensors.front();
    result.shape = read_geometry(p, context);
    p.finish();
    check_attributes(p, result.shape, context);
    return result;
}

}  // namespace neumann::reader
