#include "core/sampling/projected_polygon.h"

#include "core/sampling/warp.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }
// d turned by the angle whose cosine and sine these are.
Vec2 turned(const Vec2& d, double c, double s) { return {d.x * c - d.y * s, d.x * s + d.y * c}; }

// Clips the polygon to z > 0 (Sutherland and Hodgman 1974). Returns the number of corners.
std::size_t clip(std::span<const Vec3> polygon, std::span<Vec3> above) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if (a.z >= 0.0) above[count++] = a;
        if ((a.z > 0.0 && b.z < 0.0) || (a.z < 0.0 && b.z > 0.0)) {
            above[count] = (a * b.z - b * a.z) / (b.z - a.z);
            above[count++].z = 0.0;
        }
    }
    return count;
}

}  // namespace

ProjectedPolygon::ProjectedPolygon(std::span<const Vec3> corners, const Vec3& normal) : frame_(normal) {
    std::array<Vec3, 4> local;
    const std::size_t n = std::min(corners.size(), local.size());
    std::transform(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(n), local.begin(),
                   [&](const Vec3& p) { return frame_.to_local(p); });
    if (glm::dot(glm::cross(local[0], local[1]), local[2]) < 0.0)
        std::reverse(local.begin(), local.begin() + static_cast<std::ptrdiff_t>(n));
    std::array<Vec3, Edges::most> above;
    const std::size_t count = clip({local.data(), n}, above);
    Edges backwards;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 &a = above[i], &b = above[(i + 1) % count], across = glm::cross(a, b);
        const double size = glm::length(across);
        // An edge towards the zenith has no area; its sign is only rounding.
        if (!(std::abs(across.z) > 1e-14 * (glm::length(a) * glm::length(b)))) continue;
        const double z = across.z / size;
        area_ += 0.5 * z * std::atan2(size, glm::dot(a, b));
        const Vec2 from = glm::normalize(Vec2(a)), to = glm::normalize(Vec2(b));
        const double flat = glm::length(Vec2(across));
        const Vec2 m = flat > 0.0 ? Vec2(across) / flat : Vec2(1.0, 0.0);
        if (z > 0.0)
            outer_.add({from, to, m, z});
        else
            backwards.add({to, from, m, -z});
    }
    area_ = outer_.count > 0 ? std::clamp(area_, 0.0, pi) : 0.0;
    // The outer edges, and the inner ones from the last to the first, start where the others end.
    const auto start_of_chain = [](const Edges& edges) {
        std::size_t start = 0;
        for (std::size_t i = 0; i < edges.count; ++i)
            if (edges.edge[i].from != edges.edge[(i + edges.count - 1) % edges.count].to) start = i;
        return start;
    };
    std::reverse(backwards.edge.begin(), backwards.edge.begin() + static_cast<std::ptrdiff_t>(backwards.count));
    for (const auto& [edges, chain] : {std::pair(backwards, &inner_), std::pair(outer_, &outer_)}) {
        const std::size_t start = start_of_chain(edges);
        chain->count = 0;
        for (std::size_t i = 0; i < edges.count; ++i) chain->add(edges.edge[(start + i) % edges.count]);
    }
}

double ProjectedPolygon::Edge::height2(const Vec2& d) const {
    const double c = glm::dot(m, d), s = cross(m, d), round = z * z * s * s;
    const double high = (1.0 - z) * (1.0 + z) * c * c;
    return high / (c * c + round);
}

double ProjectedPolygon::Edge::sector(const Vec2& a, const Vec2& b) const {
    return 0.5 * z * std::atan2(z * cross(a, b), glm::dot(m, a) * glm::dot(m, b) + z * z * cross(m, a) * cross(m, b));
}

Vec2 ProjectedPolygon::Edge::end_of_sector(const Vec2& a, double area) const {
    const double arc = 2.0 * area / z;
    const Vec2 on_circle = turned({glm::dot(m, a), z * cross(m, a)}, std::cos(arc), std::sin(arc));
    return glm::normalize(turned(m, z * on_circle.x, on_circle.y));
}

// Newton's method, between bounds, for the angle from a at which the outer sector less the inner one has this share of the area.
Vec2 ProjectedPolygon::end_between(const Edge& outer, const Edge& inner, const Vec2& a, const Vec2& b, double share, double area) {
    const double whole = std::atan2(cross(a, b), glm::dot(a, b));
    double low = 0.0, high = whole, angle = share * whole;
    Vec2 d = a;
    for (int i = 0; i < 64; ++i) {
        d = turned(a, std::cos(angle), std::sin(angle));
        const double missing = share * area - (outer.sector(a, d) - inner.sector(a, d));
        (missing > 0.0 ? low : high) = angle;
        const double step = 2.0 * missing / (inner.height2(d) - outer.height2(d));
        // At a corner both heights are the same, and the step is not a number.
        const double next = angle + step;
        angle = next >= low && next <= high ? next : 0.5 * (low + high);
        // The error after a step is about its square.
        if (std::abs(step) < 1e-7 * whole || high - low < 1e-14 * whole) return turned(a, std::cos(angle), std::sin(angle));
    }
    return d;
}

Vec3 ProjectedPolygon::sample(const Vec2& u) const {
    const Edge* outer = outer_.edge.data();
    const Edge* inner = inner_.count > 0 ? inner_.edge.data() : nullptr;
    const Edge *const last_outer = outer + outer_.count - 1, *const last_inner = inner ? inner + inner_.count - 1 : nullptr;
    double left = u.x * area_;
    Vec2 a = inner ? inner->from : outer->from;
    for (;;) {
        if (!inner) a = outer->from;
        const bool ends_first = inner && inner != last_inner && (outer == last_outer || cross(inner->to, outer->to) > 0.0);
        const Vec2 b = ends_first ? inner->to : outer->to;
        const bool is_last = outer == last_outer && inner == last_inner;
        const double area = std::max(outer->sector(a, b) - (inner ? inner->sector(a, b) : 0.0), 0.0);
        if (left < area || is_last) {
            left = std::min(left, area);
            const Vec2 d = !inner       ? outer->end_of_sector(a, left)
                           : area > 0.0 ? end_between(*outer, *inner, a, b, left / area, area)
                                        : a;
            const double top = inner ? inner->height2(d) : 1.0;
            const double height2 = top + u.y * (outer->height2(d) - top);
            return frame_.to_world(Vec3(d * std::sqrt(std::max(1.0 - height2, 0.0)), std::sqrt(std::max(height2, 0.0))));
        }
        left -= area;
        a = b;
        if (ends_first)
            ++inner;
        else
            ++outer;
    }
}

}  // namespace neumann
