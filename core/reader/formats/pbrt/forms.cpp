// Makes the geometry of shapes.
#include "core/base/did_you_mean.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/pbrt/shapes.h"
#include "core/reader/meshes/mesh_text.h"

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

constexpr double turn = 2.0 * std::numbers::pi, almost_all = 1.0 - 1e-6;

// Returns radians.
double read_phi_max(Parameters& p) {
    const double degrees = p.number("phimax", 360.0);
    if (!(degrees > 0.0)) p.complain("phimax", fmt::format("phimax of {} is {}, expected more than 0", p.title(), degrees));
    return std::min(degrees, 360.0) / 360.0 * turn;
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

Shapes::Form Shapes::make_part(ShapeEntity& s, MadeMesh mesh, double area) {
    importer_.warnings.add("a part of a round shape: a mesh, cut 256 times around");
    Form form{make_object("shape", "ply", s.place())};
    form.mesh = std::move(mesh);
    add_to_world(form.element, s.to_world, s.place());
    form.area = area;
    return form;
}

Shapes::Form Shapes::make_sphere(ShapeEntity& s) {
    Parameters& p = s.parameters;
    const double radius = read_radius_of(p), a = p.number("zmin", -radius), b = p.number("zmax", radius), phi_max = read_phi_max(p);
    const double low = std::clamp(std::min(a, b), -radius, radius), high = std::clamp(std::max(a, b), -radius, radius);
    if (low == high) p.complain("zmax", fmt::format("between zmin and zmax of {}, {} and {}, nothing is left", p.title(), a, b));
    if (low > -radius * almost_all || high < radius * almost_all || phi_max < turn * almost_all) {
        const double from = std::acos(low / radius), to = std::acos(high / radius);  // angles from +z
        const auto profile = [&](double v) {
            const double theta = v == 1.0 ? to : from + v * (to - from);
            // Points and normals at the poles are exactly on the axis.
            const Vec2 n(theta == 0.0 || theta == std::numbers::pi ? 0.0 : std::sin(theta), std::cos(theta));
            return Profile{n * radius, n};
        };
        return make_part(s, make_surface_of_revolution(profile, cuts_of(from - to), phi_max), phi_max * radius * (high - low));
    }
    Form form{make_object("shape", "sphere", s.place()), Coordinates::sphere};
    add_float(form.element, "radius", radius, p.place("radius"));
    add_to_world(form.element, s.to_world, s.place());
    form.radius = radius;
    form.area = 4.0 * std::numbers::pi * radius * radius;
    return form;
}

Shapes::Form Shapes::make_disk(ShapeEntity& s) {
    Parameters& p = s.parameters;
    const double radius = read_radius_of(p), height = p.number("height", 0.0), inner = p.number("innerradius", 0.0),
                 phi_max = read_phi_max(p);
    if (!(inner >= 0.0 && inner < radius))
        p.complain("innerradius",
                   fmt::format("innerradius of {} is {}, expected at least 0 and less than radius, {}", p.title(), inner, radius));
    if (inner > 0.0 || phi_max < turn * almost_all) {
        const auto profile = [&](double v) { return Profile{{radius + v * (inner - radius), height}, {0.0, 1.0}}; };
        return make_part(s, make_surface_of_revolution(profile, 1, phi_max), 0.5 * phi_max * (radius * radius - inner * inner));
    }
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
    const double radius = read_radius_of(p), a = p.number("zmin", -1.0), b = p.number("zmax", 1.0), phi_max = read_phi_max(p);
    if (a == b) p.complain("zmax", fmt::format("zmin and zmax of {} are both {}", p.title(), a));
    const double low = std::min(a, b), high = std::max(a, b);
    if (phi_max < turn * almost_all) {
        const auto profile = [&](double v) { return Profile{{radius, low + v * (high - low)}, {1.0, 0.0}}; };
        return make_part(s, make_surface_of_revolution(profile, 1, phi_max), phi_max * radius * (high - low));
    }
    Form form{make_object("shape", "cylinder", s.place())};
    add_point(form.element, "p0", {0.0, 0.0, low}, p.place("zmin"));
    add_point(form.element, "p1", {0.0, 0.0, high}, p.place("zmax"));
    add_float(form.element, "radius", radius, p.place("radius"));
    add_to_world(form.element, s.to_world, s.place());
    form.area = turn * radius * (high - low);
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
