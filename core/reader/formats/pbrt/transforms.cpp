#include "core/reader/formats/pbrt/transforms.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::reader::pbrt {

namespace {

// The map from the world to a camera that looks along +z, with +x to the right and +y up.
Mat4 look_at(const std::vector<double>& n, const Location& place) {
    const Vec3 eye(n[0], n[1], n[2]), target(n[3], n[4], n[5]), up(n[6], n[7], n[8]);
    if (eye == target) throw InputError(place, "LookAt looks from a point to the same point");
    if (up == Vec3(0.0)) throw InputError(place, "the up vector of LookAt is zero");
    const Vec3 forward = glm::normalize(target - eye), across = glm::cross(glm::normalize(up), forward);
    if (!(glm::length(across) > 1e-12)) throw InputError(place, "the up vector of LookAt points along the view");
    const Vec3 right = glm::normalize(across);
    const Mat4 from_camera(glm::dvec4(right, 0.0), glm::dvec4(glm::cross(forward, right), 0.0), glm::dvec4(forward, 0.0),
                           glm::dvec4(eye, 1.0));
    return glm::inverse(from_camera);
}

Mat4 rotation(const std::vector<double>& n, const Location& place) {
    const Vec3 axis(n[1], n[2], n[3]);
    if (axis == Vec3(0.0)) throw InputError(place, "the axis of Rotate is zero");
    return glm::rotate(Mat4(1.0), glm::radians(n[0]), axis / max_component(glm::abs(axis)));
}

// The numbers are column by column.
Mat4 matrix(const std::string& directive, const std::vector<double>& n, const Location& place) {
    Mat4 m;
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = n[static_cast<std::size_t>(i)];
    if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] == 0.0)
        throw InputError(place,
                         fmt::format("the matrix of {} is projective, expected 0 0 0 1 as every fourth of its numbers", directive));
    return m / m[3][3];
}

Mat4 step(const std::string& directive, const std::vector<double>& n, const Location& place) {
    if (directive == "Identity") return Mat4(1.0);
    if (directive == "Translate") return glm::translate(Mat4(1.0), Vec3(n[0], n[1], n[2]));
    if (directive == "Scale") return glm::scale(Mat4(1.0), Vec3(n[0], n[1], n[2]));
    if (directive == "Rotate") return rotation(n, place);
    if (directive == "LookAt") return look_at(n, place);
    return matrix(directive, n, place);
}

}  // namespace

std::optional<std::size_t> transform_size(const std::string& directive) {
    if (directive == "Identity") return 0;
    if (directive == "Translate" || directive == "Scale") return 3;
    if (directive == "Rotate") return 4;
    if (directive == "LookAt") return 9;
    if (directive == "Transform" || directive == "ConcatTransform") return 16;
    return std::nullopt;
}

Mat4 transformed_by(const std::string& directive, const std::vector<double>& numbers, const Mat4& current, const Location& place) {
    const Mat4 m = step(directive, numbers, place);
    const bool replaces = directive == "Identity" || directive == "Transform";
    const Mat4 result = replaces ? m : current * m;
    for (int i = 0; i < 4; ++i)
        if (!is_finite(Vec3(result[i])))
            throw InputError(place, fmt::format("{} makes a matrix with numbers beyond the range of double precision", directive));
    return result;
}

}  // namespace neumann::reader::pbrt
