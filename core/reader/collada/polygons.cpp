#include "core/reader/collada/polygons.h"

#include "core/base/frame.h"

#include <algorithm>
#include <cmath>

namespace neumann::reader::collada {

namespace {

// Twice the area of a triangle, positive if it is counter-clockwise.
double area(const Vec2& a, const Vec2& b, const Vec2& c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

bool is_within(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& c) {
    return area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0;
}

// Seen from the side from which it is counter-clockwise, as a whole; empty if it has no area.
std::vector<Vec2> seen_from_above(const std::vector<Vec3>& corners) {
    Vec3 normal(0.0);
    for (std::size_t i = 2; i < corners.size(); ++i) normal += glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
    const double length = glm::length(normal);
    if (!(length > 0.0) || !std::isfinite(length)) return {};
    const Frame frame(normal / length);
    std::vector<Vec2> flat;
    for (const Vec3& p : corners) flat.emplace_back(glm::dot(p - corners[0], frame.s), glm::dot(p - corners[0], frame.t));
    return flat;
}

bool turns_back(const std::vector<Vec2>& p) {
    // Radians; less is rounding in the file.
    constexpr double least = 1e-5;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec2 &a = p[i], &b = p[(i + 1) % p.size()], &c = p[(i + 2) % p.size()];
        if (area(a, b, c) < -least * glm::length(b - a) * glm::length(c - b)) return true;
    }
    return false;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> cut_ears(const std::vector<Vec3>& corners) {
    const std::vector<Vec2> p = seen_from_above(corners);
    if (p.size() < 4 || !turns_back(p)) return {};
    std::vector<std::uint32_t> left(p.size());
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<std::uint32_t>(i);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::size_t at = 0, tried = 0;
    while (left.size() > 3 && tried < left.size()) {
        const std::size_t n = left.size();
        const std::array<std::uint32_t, 3> ear = {left[(at + n - 1) % n], left[at % n], left[(at + 1) % n]};
        const Vec2 &a = p[ear[0]], &b = p[ear[1]], &c = p[ear[2]];
        const bool is_ear = area(a, b, c) >= 0.0 && std::ranges::none_of(left, [&](std::uint32_t i) {
                                return p[i] != a && p[i] != b && p[i] != c && is_within(p[i], a, b, c);
                            });
        if (is_ear) {
            triangles.push_back(ear);
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(at % n));
            tried = 0;
        } else {
            ++at;
            ++tried;
        }
        at %= left.size();
    }
    if (left.size() > 3) return {};
    triangles.push_back({left[0], left[1], left[2]});
    return triangles;
}

}  // namespace neumann::reader::collada
