// The geometry of shapes.
#include "core/reader/import/make_elements.h"
#include "core/reader/meshes/mesh_text.h"
#include "core/reader/pbrt/shapes.h"
#include "core/reader/xml/did_you_mean.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::reader::pbrt {

namespace {

const std::vector<std::string> shape_types = {"bilinearmesh", "cylinder", "disk",        "loopsubdiv",
                                              "plymesh",      "sphere",   "trianglemesh"};

double read_radius_of(Parameters& p) {
    const double radius = p.number("radius", 1.0);
    if (radius > 0.0) return radius;
    p.complain("radius", fmt::format("radius of {} is {}, expected more than 0", p.title(), radius));
    return 1.0;
}

void add_to_world(Element& e, const Mat4& m, const Location& place) {
    if (m != Mat4(1.0)) add_matrix(e, "to_world", m, place);
}

}  // namespace

Shapes::Form Shapes::make_form(ShapeEntity& s) {
    if (s.type == "sphere") return make_sphere(s);
    if (s.type == "disk") return make_disk(s);
    if (s.type == "cylinder") return make_cylinder(s);
    if (std::find(shape_types.begin(), shape_types.end(), s.type) != shape_types.end()) return make_mesh(s);
    throw Unknown(s.place(), fmt::format("shape type '{}' is not supported", printable(s.type)),
                  "; " + allowed_instead(s.type, shape_types), "left out");
}

// Parts of round shapes are refused.
void Shapes::check_full(Parameters& p, const std::string& name, double value) {
    const double given = p.number(name, value);
    const bool is_full = name == "zmin" ? given <= value : given >= value;
    if (std::abs(given - value) > 1e-6 * std::abs(value) && !is_full)
        p.refuse(name, fmt::format("{} of {} is {}", name, p.title(), given),
                 fmt::format(", expected {}: only whole ones are supported", value));
}

Shapes::Form Shapes::make_sphere(ShapeEntity& s) {
    Parameters& p = s.parameters;
    const double radius = read_radius_of(p);
    check_full(p, "zmin", -radius);
    check_full(p, "zmax", radius);
    check_full(p, "phimax", 360.0);
    Form form{make_object("shape", "sphere", s.place()), Coordinates::sphere};
    add_float(form.element, "radius", radius, p.place("radius"));
    add_to_world(form.element, s.to_world, s.place());
    form.radius = radius;
    form.area = 4.0 * std::numbers::pi * radius * radius;
    return form;
}

Shapes::Form Shapes::make_disk(ShapeEntity& s) {
    Parameters& p = s.parameters;
    const double radius = read_radius_of(p), height = p.number("height", 0.0);
    if (const double inner = p.number("innerradius", 0.0); inner != 0.0)
        p.refuse("innerradius", fmt::format("innerradius of {} is {}", p.title(), inner),
                 ", expected 0: only whole ones are supported");
    check_full(p, "phimax", 360.0);
    Form form{make_object("shape", "disk", s.place()), Coordinates::disk};
    const Mat4 own = glm::scale(glm::translate(Mat4(1.0), Vec3(0.0, 0.0, height)), Vec3(radius, radius, 1.0));
    add_to_world(form.element, s.to_world * own, s.place());
    form.radius = radius;
    form.height = height;
    form.area = std::numbers::pi * radius * radius;
    return form;
}

Shapes::Form Shapes::make_cylinder(ShapeEntity& s) {
    Parameters& p = s.parameters;
    const double radius = read_radius_of(p), a = p.number("zmin", -1.0), b = p.number("zmax", 1.0);
    if (a == b) p.complain("zmax", fmt::format("zmin and zmax of {} are both {}", p.title(), a));
    check_full(p, "phimax", 360.0);
    Form form{make_object("shape", "cylinder", s.place())};
    add_point(form.element, "p0", {0.0, 0.0, std::min(a, b)}, p.place("zmin"));
    add_point(form.element, "p1", {0.0, 0.0, std::max(a, b)}, p.place("zmax"));
    add_float(form.element, "radius", radius, p.place("radius"));
    add_to_world(form.element, s.to_world, s.place());
    form.area = 2.0 * std::numbers::pi * radius * std::abs(b - a);
    return form;
}

Shapes::Form Shapes::make_mesh(ShapeEntity& s) {
    Parameters& p = s.parameters;
    Form form{make_object("shape", "ply", s.place())};
    form.mesh = s.type == "trianglemesh"   ? make_triangle_mesh(p)
                : s.type == "plymesh"      ? read_ply_mesh(p, importer_)
                : s.type == "bilinearmesh" ? make_bilinear_mesh(p, importer_)
                                           : make_loop_surface(p);
    add_to_world(form.element, s.to_world, s.place());
    return form;
}

}  // namespace neumann::reader::pbrt
