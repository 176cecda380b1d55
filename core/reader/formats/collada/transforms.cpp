#include "core/reader/formats/collada/nodes.h"
#include "core/reader/formats/collada/texts.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::reader::collada {

Mat4 read_matrix(const Element& e) {
    const std::vector<double> v = read_numbers(e, 16);
    Mat4 m(1.0);
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) m[column][row] = v[static_cast<std::size_t>(4 * row + column)];
    if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0)
        throw InputError(e.place, fmt::format("the last row of <{}> is not 0 0 0 1", e.tag));
    return m;
}

namespace {

Mat4 read_rotation(const Element& e) {
    const std::vector<double> v = read_numbers(e, 4);
    const Vec3 axis(v[0], v[1], v[2]);
    if (axis == Vec3(0.0)) throw InputError(e.place, "the axis of <rotate> is zero");
    return glm::rotate(Mat4(1.0), glm::radians(v[3]), axis / max_component(glm::abs(axis)));
}

// <lookat> holds the node's place, the point at which its −z looks, and what is up.
Mat4 read_lookat(const Element& e) {
    const std::vector<double> v = read_numbers(e, 9);
    const Vec3 origin(v[0], v[1], v[2]), target(v[3], v[4], v[5]), up(v[6], v[7], v[8]);
    const double distance = length_of(target - origin), height = length_of(up);
    if (!(distance > 0.0)) throw InputError(e.place, "<lookat> looks from a point at the same point");
    const Vec3 back = (origin - target) / distance;
    const Vec3 across = height > 0.0 ? glm::cross(up / height, back) : Vec3(0.0);
    if (length_of(across) < 1e-12) throw InputError(e.place, "up of <lookat> points along the view, or is zero");
    const Vec3 right = glm::normalize(across);
    return {glm::dvec4(right, 0.0), glm::dvec4(glm::cross(back, right), 0.0), glm::dvec4(back, 0.0), glm::dvec4(origin, 1.0)};
}

}  // namespace

Mat4 read_transforms(const Element& node) {
    Mat4 m(1.0);
    const auto triple = [](const Element& e) {
        const std::vector<double> v = read_numbers(e, 3);
        return Vec3(v[0], v[1], v[2]);
    };
    for (const Element& e : node.children) {
        if (e.tag == "matrix") m = m * read_matrix(e);
        if (e.tag == "rotate") m = m * read_rotation(e);
        if (e.tag == "translate") m = glm::translate(m, triple(e));
        if (e.tag == "scale") m = glm::scale(m, triple(e));
        if (e.tag == "lookat") m = m * read_lookat(e);
        if (e.tag == "skew") throw InputError(e.place, "<skew> is not supported, expected the same as a <matrix>");
    }
    return m;
}

}  // namespace neumann::reader::collada
