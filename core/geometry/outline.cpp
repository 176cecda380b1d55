#include "core/geometry/outline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace neumann {

namespace {

constexpr int sides_of_circle = 48;

// An ellipse center + u cos + v sin as a polygon.
void add_ellipse(const Vec3& center, const Vec3& u, const Vec3& v, std::vector<Segment>& lines) {
    const auto at = [&](int i) {
        const double angle = 2.0 * std::numbers::pi * i / sides_of_circle;
        return center + u * std::cos(angle) + v * std::sin(angle);
    };
    for (int i = 0; i < sides_of_circle; ++i) lines.push_back({at(i), at((i + 1) % sides_of_circle)});
}

struct EdgeOfFaces {
    Segment segment;
    int faces = 0;
    Vec3 normal;  // of the first one
    bool is_drawn = false;
};

using VertexKey = std::tuple<double, double, double>;
VertexKey vertex_key(const Vec3& p) { return {p.x, p.y, p.z}; }

// Vertices at the same place are one, since meshes have several of them where normals or texture coordinates differ.
void add_edges(const Shape& shape, std::size_t triangles, const Vec3& direction, std::vector<Segment>& lines) {
    std::map<std::pair<VertexKey, VertexKey>, EdgeOfFaces> edges;
    for (std::uint32_t t = 0; t < triangles; ++t) {
        const std::array<Vec3, 3> at = corners_of(shape, t).at;
        const Vec3 across = glm::cross(at[1] - at[0], at[2] - at[0]);
        const double size = glm::length(across);
        if (!(size > 0.0)) continue;
        const Vec3 normal = across / size;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 &a = at[k], &b = at[(k + 1) % 3];
            const bool ordered = vertex_key(a) < vertex_key(b);
            EdgeOfFaces& edge = edges[ordered ? std::pair(vertex_key(a), vertex_key(b)) : std::pair(vertex_key(b), vertex_key(a))];
            if (edge.faces++ == 0) {
                edge.segment = {a, b};
                edge.normal = normal;
                continue;
            }
            const bool turns_away = glm::dot(edge.normal, direction) * glm::dot(normal, direction) < 0.0;
            edge.is_drawn = edge.faces > 2 || turns_away || glm::dot(edge.normal, normal) < std::cos(least_bend);
        }
    }
    for (const auto& [ends, edge] : edges)
        if (edge.faces == 1 || edge.is_drawn) lines.push_back(edge.segment);
}

void add_rims(const Cylinder& c, const Vec3& direction, std::vector<Segment>& lines) {
    const Vec3 u = c.axes.s * c.radius, v = c.axes.t * c.radius, top = c.base + c.axis * c.length;
    add_ellipse(c.base, u, v, lines);
    add_ellipse(top, u, v, lines);
    const Vec3 across = glm::cross(c.axis, direction);
    const double size = glm::length(across);
    if (size < 1e-6) return;  // seen along its axis
    for (const double side : {-1.0, 1.0}) {
        const Vec3 aside = across * (side * c.radius / size);
        lines.push_back({c.base + aside, top + aside});
    }
}

}  // namespace

std::vector<Segment> outline(std::span<const Shape> shapes, const Vec3& direction, std::size_t most) {
    std::vector<Segment> lines;
    const Frame eye(direction);
    for (const Shape& shape : shapes)
        if (const TriangleMesh* mesh = mesh_of(shape))
            add_edges(shape, mesh->triangles.size(), direction, lines);
        else if (const auto* sphere = std::get_if<Sphere>(&shape))
            add_ellipse(sphere->center, eye.s * sphere->radius, eye.t * sphere->radius, lines);
        else if (const auto* disk = std::get_if<Disk>(&shape))
            add_ellipse(disk->center, disk->u, disk->v, lines);
        else
            add_rims(std::get<Cylinder>(shape), direction, lines);
    if (lines.size() <= most) return lines;
    const auto length2 = [](const Segment& s) { return glm::dot(s.to - s.from, s.to - s.from); };
    std::ranges::stable_sort(lines, std::ranges::greater{}, length2);
    lines.resize(most);
    return lines;
}

}  // namespace neumann
