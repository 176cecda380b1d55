#include "operators/fields/patches/chart.h"

namespace neumann {

namespace {

// Samples x in [0, 1] with density proportional to (1 − x) a + x b.
double sample_linear(double u, double a, double b) {
    const double root = a + std::sqrt(a * a + u * (b * b - a * a));
    return root > 0.0 ? u * (a + b) / root : 0.0;
}

}  // namespace

QuadMap::QuadMap(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& normal) : a_(a) {
    x_ = glm::normalize(b - a);
    y_ = glm::cross(normal, x_);
    const auto in_plane = [&](const Vec3& v) { return Vec2(glm::dot(v, x_), glm::dot(v, y_)); };
    e_ = in_plane(b - a);
    f_ = in_plane(d - a);
    g_ = in_plane((a - b) + (c - d));
    // A term of rounding errors alone is dropped, because dividing by it would lose digits.
    is_parallelogram_ = glm::length(g_) < 1e-14 * (glm::length(e_) + glm::length(f_));
    if (is_parallelogram_) g_ = Vec2(0.0);
    j0_ = cross(e_, f_);
    js_ = cross(e_, g_);
    jt_ = cross(g_, f_);
    of_area_ = 1.0 / j0_;
}

Vec2 QuadMap::uniform_in_trapezoids(const Cell& cell, const Vec2& u) const {
    const double middle = j0_ + 0.5 * jt_ * (cell.t0 + cell.t1);
    const double s = cell.s0 + (cell.s1 - cell.s0) * sample_linear(u.x, middle + js_ * cell.s0, middle + js_ * cell.s1);
    const double at_s = j0_ + js_ * s;
    return {s, cell.t0 + (cell.t1 - cell.t0) * sample_linear(u.y, at_s + jt_ * cell.t0, at_s + jt_ * cell.t1)};
}

Chart::Chart(const Geometry& geometry, std::uint32_t shape) : shape_(shape), area_(geometry.area(shape)) {
    if (const auto* sphere = std::get_if<Sphere>(&geometry.shapes()[shape])) {
        lengths_ = {pi * sphere->radius, 1.5 * pi * sphere->radius};
        closed_in_t_ = true;
    } else if (const auto* cylinder = std::get_if<Cylinder>(&geometry.shapes()[shape])) {
        lengths_ = {cylinder->length, 2.0 * pi * cylinder->radius};
        closed_in_t_ = true;
    } else {
        const Disk& disk = std::get<Disk>(geometry.shapes()[shape]);
        lengths_ = {glm::length(disk.u) * 1.8, glm::length(disk.v) * 1.8};
    }
}

Chart::Chart(std::uint32_t shape, const std::array<Vec3, 4>& corners, const Vec3& normal, std::uint32_t lower, std::uint32_t upper)
    : shape_(shape),
      quad_(QuadMap(corners[0], corners[1], corners[2], corners[3], normal)),
      corners_(corners),
      up_(glm::cross(normal, corners[2] - corners[0])),
      lower_(lower),
      upper_(upper),
      lengths_(quad_->lengths()) {}

Chart::Chart(std::uint32_t shape, std::size_t faces, double area)
    : shape_(shape), area_(area), lengths_(std::sqrt(area)), small_faces_(faces) {}

}  // namespace neumann
