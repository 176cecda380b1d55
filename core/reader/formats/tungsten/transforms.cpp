#include "core/reader/formats/tungsten/transforms.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::reader::tungsten {

namespace {

using Axes = std::array<Vec3, 3>;

Vec3 unit(const Vec3& v) {
    const double length = length_of(v);
    return length > 0.0 ? v / length : v;
}

// The axes in the order in which they keep their direction: given axes come before others, and among each of these z
// before y before x.
std::array<std::size_t, 3> order_of(const std::array<bool, 3>& given) {
    const auto [x, y, z] = given;
    constexpr std::array<std::size_t, 3> zyx = {2, 1, 0}, zxy = {2, 0, 1}, yxz = {1, 0, 2}, yzx = {1, 2, 0}, xzy = {0, 2, 1};
    if (z) return x && !y ? zxy : zyx;
    if (y) return x ? yxz : yzx;
    return x ? xzy : zyx;
}

// The first axis keeps its direction, and each other one is made perpendicular to those before; one that is parallel to
// them is replaced.
void make_perpendicular(Axes& axes, const std::array<std::size_t, 3>& order) {
    constexpr double smallest_sine = 0.003;
    Vec3 &a = axes[order[0]], &b = axes[order[1]], &c = axes[order[2]];
    a = unit(a);
    const auto replace_if_along = [&](Vec3& v, const Vec3& across, const Vec3& other) {
        v = unit(length_of(across) > smallest_sine * length_of(v) ? across : other);
    };
    b = unit(b);
    replace_if_along(b, b - a * glm::dot(a, b), glm::cross(a, std::abs(a.x) > std::abs(a.y) ? Vec3(0, 1, 0) : Vec3(1, 0, 0)));
    c = unit(c);
    replace_if_along(c, c - a * glm::dot(a, c) - b * glm::dot(b, c), glm::cross(a, b));
}

// Rotates, in degrees, about z, then x, then y, about y in the other sense.
Mat4 rotation(const Vec3& degrees) {
    const Vec3 angle = glm::radians(degrees);
    Mat4 m = glm::rotate(Mat4(1.0), -angle.y, Vec3(0, 1, 0));
    m = glm::rotate(m, angle.x, Vec3(1, 0, 0));
    return glm::rotate(m, angle.z, Vec3(0, 0, 1));
}

Mat4 read_parts(JsonObject transform) {
    Axes axes = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    std::array<bool, 3> given = {};
    const auto take = [&](std::size_t axis, const std::string& name, const Vec3& from) {
        const std::optional<Vec3> v = find_vector(transform, name);
        if (!v) return;
        axes[axis] = *v - from;
        given[axis] = true;
        if (length_of(axes[axis]) > 0.0) return;
        transform.complain(name, name == "look_at" ? "look_at is the position" : fmt::format("{} has no length", name));
        axes[axis] = Vec3(axis == 0, axis == 1, axis == 2);
    };
    const Vec3 position = find_vector(transform, "position").value_or(Vec3(0.0));
    take(2, "look_at", position);
    take(1, "up", Vec3(0.0));
    take(0, "x_axis", Vec3(0.0));
    take(1, "y_axis", Vec3(0.0));
    take(2, "z_axis", Vec3(0.0));
    make_perpendicular(axes, order_of(given));
    // The axes become right-handed; one that is not given turns around.
    if (glm::dot(glm::cross(axes[0], axes[1]), axes[2]) < 0.0) {
        Vec3& turned = axes[!given[0] ? 0 : !given[1] ? 1 : 2];
        turned = -turned;
    }
    const Vec3 scale = find_vector(transform, "scale").value_or(Vec3(1.0)),
               angles = find_vector(transform, "rotation").value_or(Vec3(0.0));
    transform.finish();
    Mat4 m(1.0);
    for (int i = 0; i < 3; ++i) m[i] = glm::dvec4(axes[static_cast<std::size_t>(i)] * scale[i], 0.0);
    m = rotation(angles) * m;
    m[3] = glm::dvec4(position, 1.0);
    return m;
}

bool is_representable(const Mat4& m) {
    for (int i = 0; i < 4; ++i)
        if (!is_finite(Vec3(m[i])) || !std::isfinite(length_of(Vec3(m[i])))) return false;
    return true;
}

}  // namespace

Mat4 read_transform(JsonObject& parent) {
    constexpr const char* name = "transform";
    const nlohmann::json* value = parent.value(name);
    if (!value) return Mat4(1.0);
    Mat4 m(1.0);
    if (value->is_array()) {
        const std::vector<double> n = parent.numbers(name, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < 4; ++column) m[column][row] = n[static_cast<std::size_t>(4 * row + column)];
        if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0)
            parent.complain(name, "the last row of transform, its last four numbers, is not 0 0 0 1");
    } else if (value->is_object()) {
        m = read_parts(*parent.object(name));
    } else {
        parent.complain(name, fmt::format("transform is {}, expected an object or an array of 16 numbers", with_article(*value)));
    }
    if (!is_representable(m)) parent.complain(name, "transform is beyond the range of numbers");
    return parent.is_wrong(name) ? Mat4(1.0) : m;
}

Mat4 rotation_of(const Mat4& m) {
    Mat4 result(1.0);
    for (int i = 0; i < 3; ++i) result[i] = glm::dvec4(unit(Vec3(m[i])), 0.0);
    return result;
}

Vec3 scale_of(const Mat4& m) { return {length_of(Vec3(m[0])), length_of(Vec3(m[1])), length_of(Vec3(m[2]))}; }

bool is_without_shear(const Mat4& m) {
    constexpr double tolerance = 1e-4;
    const Mat4 r = rotation_of(m);
    return std::abs(glm::dot(r[0], r[1])) < tolerance && std::abs(glm::dot(r[0], r[2])) < tolerance &&
           std::abs(glm::dot(r[1], r[2])) < tolerance;
}

}  // namespace neumann::reader::tungsten
