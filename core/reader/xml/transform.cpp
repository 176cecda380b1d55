#include "core/reader/xml/transform.h"

#include "core/base/frame.h"
#include "core/reader/xml/numbers.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::reader {

namespace {

Mat4 parse_rotate(const Element& e) {
    const Vec3 axis = parse_xyz(e, 0.0);
    if (axis == Vec3(0.0)) throw InputError(e.place, "the axis of <rotate> is zero");
    return glm::rotate(Mat4(1.0), glm::radians(parse_number(e.attribute("angle"))), axis / max_component(glm::abs(axis)));
}

// Camera space has +z forwards, +x left and +y up.
Mat4 parse_lookat(const Element& e) {
    const Vec3 origin = parse_triple(e.attribute("origin")), target = parse_triple(e.attribute("target"));
    if (origin == target) throw InputError(e.place, "origin and target of <lookat> are the same point");
    const Vec3 forward = glm::normalize(target - origin);
    const Attribute* given = e.find("up");
    Vec3 up = given ? parse_triple(*given) : Vec3(0.0);
    if (up == Vec3(0.0)) up = Frame(forward).s;
    const Vec3 across = glm::cross(glm::normalize(up), forward);
    if (glm::length(across) < 1e-12) throw InputError(given ? given->place : e.place, "up of <lookat> points along the view");
    const Vec3 left = glm::normalize(across);
    return Mat4(glm::dvec4(left, 0.0), glm::dvec4(glm::cross(forward, left), 0.0), glm::dvec4(forward, 0.0),
                glm::dvec4(origin, 1.0));
}

// The numbers are row by row, 3×3 or 4×4.
Mat4 parse_matrix(const Element& e) {
    const Attribute& value = e.attribute("value");
    const std::vector<double> v = parse_numbers(value);
    if (v.size() != 9 && v.size() != 16)
        throw InputError(value.place, fmt::format("<matrix> has {} numbers, expected 9 or 16", v.size()));
    const int n = v.size() == 9 ? 3 : 4;
    Mat4 m(1.0);
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column) m[column][row] = v[static_cast<std::size_t>(row * n + column)];
    if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0)
        throw InputError(value.place, "the last row of <matrix> is not 0 0 0 1");
    return m;
}

Mat4 parse_operation(const Element& e) {
    if (e.tag == "translate") return glm::translate(Mat4(1.0), parse_xyz(e, 0.0));
    if (e.tag == "scale") return glm::scale(Mat4(1.0), parse_xyz(e, 1.0));
    if (e.tag == "rotate") return parse_rotate(e);
    if (e.tag == "lookat") return parse_lookat(e);
    return parse_matrix(e);
}

}  // namespace

Mat4 parse_transform(const Element& transform) {
    Mat4 m(1.0);
    for (const Element& e : transform.children) m = parse_operation(e) * m;
    return m;
}

bool is_invertible(const Mat4& m) {
    const glm::dmat3 linear(m);
    glm::dmat3 directions;
    for (int i = 0; i < 3; ++i) {
        const double largest = max_component(glm::abs(linear[i]));
        if (!(largest > 0.0) || !std::isfinite(largest)) return false;
        directions[i] = glm::normalize(linear[i] / largest);
    }
    return std::abs(glm::determinant(directions)) > 1e-12;
}

}  // namespace neumann::reader
