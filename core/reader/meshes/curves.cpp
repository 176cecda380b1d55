#include "core/reader/meshes/curves.h"

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/reader/meshes/mesh_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace neumann {

namespace {

constexpr double pi = std::numbers::pi, step_of_bends = pi / sides_of_tubes;

// A polygon around the curve. `normal` is that of the surface, as components along the radius and the tangent.
struct Ring {
    Vec3 center, tangent;
    double radius;
    Vec2 normal;
    double v;             // texture coordinate along the curve
    bool begins = false;  // not joined to the previous ring, which is in the same place
};

double bend(const Vec3& a, const Vec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

// Adds rings one after the other, joined by triangles. The first and the last one have the radius 0 and close the tube.
void add_tube(TriangleMesh& mesh, const std::vector<Ring>& rings) {
    // The radius is widened so that the perimeter is that of the circle.
    constexpr std::uint32_t stride = sides_of_tubes + 1;
    const double widened = (pi / sides_of_tubes) / std::sin(pi / sides_of_tubes);
    if (mesh.vertices.size() + rings.size() * (sides_of_tubes + 1) > max_mesh_count)
        throw InputError(fmt::format("the tubes have more than {}", counted(max_mesh_count, "vertex")));
    Vec3 across = Frame(rings.front().tangent).s;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        const Ring& ring = rings[i];
        across = glm::normalize(across - ring.tangent * glm::dot(across, ring.tangent));
        const Vec3 up = glm::cross(ring.tangent, across);
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (int side = 0; side <= sides_of_tubes; ++side) {
            const double part = static_cast<double>(side) / sides_of_tubes, angle = side == sides_of_tubes ? 0.0 : 2.0 * pi * part;
            const Vec3 radial = across * std::cos(angle) + up * std::sin(angle);
            Vec3 vertex = ring.center + radial * (ring.radius * widened);
            // Rings that turn around a joint share the points on their axis.
            if (i > 0 && !ring.begins)
                if (const Vec3& before = mesh.vertices[mesh.vertices.size() - stride];
                    glm::distance(vertex, before) < 1e-7 * ring.radius)
                    vertex = before;
            mesh.vertices.push_back(vertex);
            mesh.normals.push_back(glm::normalize(radial * ring.normal.x + ring.tangent * ring.normal.y));
            mesh.uv.emplace_back(part, ring.v);
        }
        if (i == 0 || ring.begins) continue;
        const auto differ = [&](std::uint32_t a, std::uint32_t b) { return mesh.vertices[a] != mesh.vertices[b]; };
        for (std::uint32_t a = first - stride; a + 1 < first; ++a) {
            if (rings[i - 1].radius > 0.0 && differ(a + 1, a + 1 + stride)) mesh.triangles.push_back({a, a + 1, a + 1 + stride});
            if (ring.radius > 0.0 && differ(a, a + stride)) mesh.triangles.push_back({a, a + 1 + stride, a + stride});
        }
    }
}

// Adds a ball cut by rings, from the pole behind to the widest ring, or from there to the pole ahead.
void add_round_end(std::vector<Ring>& rings, const ControlPoint& p, const Vec3& tangent, bool ahead, double v) {
    constexpr int steps = sides_of_tubes / 2;
    for (int i = ahead ? 1 : 0; ahead ? i <= steps : i < steps; ++i) {
        const double latitude = 0.5 * pi * (ahead ? i : i - steps) / steps;
        const bool is_pole = i == (ahead ? steps : 0);
        const double cosine = is_pole ? 0.0 : std::cos(latitude), sine = std::sin(latitude);
        rings.push_back({p.position + tangent * (p.radius * sine), tangent, p.radius * cosine, {cosine, sine}, v});
    }
}

// Points at the same place count once, with the larger radius.
std::vector<ControlPoint> distinct(const std::vector<ControlPoint>& points) {
    std::vector<ControlPoint> result;
    for (const ControlPoint& p : points)
        if (result.empty() || result.back().position != p.position)
            result.push_back(p);
        else
            result.back().radius = std::max(result.back().radius, p.radius);
    return result;
}

// A cubic piece of a spline: its value and derivative at t from 0 to 1, of position and radius.
class Piece {
public:
    explicit Piece(const ControlPoint* p) {
        for (int i = 0; i < 4; ++i) p_[i] = glm::dvec4(p[i].position, p[i].radius);
    }
    glm::dvec4 at(double t) const {
        const double s = 1.0 - t;
        return (p_[0] * (s * s * s) + p_[1] * (3.0 * t * t * t - 6.0 * t * t + 4.0) +
                p_[2] * (3.0 * s * s * s - 6.0 * s * s + 4.0) + p_[3] * (t * t * t)) /
               6.0;
    }
    glm::dvec4 slope(double t) const {
        const double s = 1.0 - t;
        return (p_[0] * (-s * s) + p_[1] * (3.0 * t * t - 4.0 * t) - p_[2] * (3.0 * s * s - 4.0 * s) + p_[3] * (t * t)) / 2.0;
    }
    // The largest second derivative, which is at one of the ends because it is linear in t.
    double curvature() const {
        return std::max(glm::length(p_[0] - 2.0 * p_[1] + p_[2]), glm::length(p_[1] - 2.0 * p_[2] + p_[3]));
    }

private:
    glm::dvec4 p_[4];
};

}  // namespace

std::vector<Curve> read_curves(const std::string& path, std::size_t least) {
    const std::string bytes = read_input(path);
    MeshText text(path, bytes, MeshText::Syntax::plain);
    std::vector<Curve> curves;
    Curve curve;
    const auto finish = [&] {
        if (curve.points.empty()) return;
        if (curve.points.size() < least)
            throw InputError(Location{path, static_cast<int>(curve.line), 1},
                             fmt::format("the curve has {}, expected at least {}", counted(curve.points.size(), "point"), least));
        curves.push_back(std::move(curve));
        curve = {};
    };
    for (; !text.at_end(); text.next_line()) {
        if (text.at_line_end()) {
            finish();
            continue;
        }
        if (curve.points.empty()) curve.line = text.place().line;
        ControlPoint p{};
        for (int i = 0; i < 3; ++i) p.position[i] = text.number();
        p.radius = text.number();
        if (p.radius < 0.0) text.fail(fmt::format("the radius is {}, expected at least 0", p.radius));
        text.expect_line_end();
        curve.points.push_back(p);
    }
    finish();
    if (curves.empty()) throw InputError(path + ": has no curves, expected lines of four numbers, x y z and a radius");
    return curves;
}

void add_linear_tube(TriangleMesh& mesh, const Curve& curve) {
    constexpr double least_bend = 1e-7;
    const std::vector<ControlPoint> p = distinct(curve.points);
    if (std::all_of(p.begin(), p.end(), [](const ControlPoint& at) { return at.radius == 0.0; })) return;
    const std::size_t pieces = p.size() - 1;
    std::vector<Ring> rings;
    const auto tangent = [&](std::size_t i) {
        return pieces == 0 ? Vec3(0.0, 0.0, 1.0) : glm::normalize(p[i + 1].position - p[i].position);
    };
    add_round_end(rings, p.front(), tangent(0), false, 0.0);
    for (std::size_t i = 0; i < pieces; ++i) {
        const Vec3 t = tangent(i);
        const bool is_straight = i > 0 && bend(tangent(i - 1), t) < least_bend;
        const double taper = (p[i].radius - p[i + 1].radius) / glm::distance(p[i + 1].position, p[i].position);
        const auto v = [&](std::size_t k) { return static_cast<double>(k) / static_cast<double>(pieces); };
        rings.push_back({p[i].position, is_straight ? tangent(i - 1) : t, p[i].radius, {1.0, taper}, v(i), is_straight});
        rings.push_back({p[i + 1].position, t, p[i + 1].radius, {1.0, taper}, v(i + 1)});
        if (i + 1 == pieces) continue;
        // The rings that turn around the joint form a part of a ball on its outer side.
        const Vec3 next = tangent(i + 1);
        const double angle = bend(t, next);
        const int steps = static_cast<int>(std::ceil(angle / step_of_bends));
        const Vec3 aside = next - t * glm::dot(next, t);
        const Vec3 side = length_of(aside) > 1e-12 ? glm::normalize(aside) : Frame(t).s;
        for (int k = 1; k < steps; ++k) {
            const double turned = angle * k / steps;
            rings.push_back(
                {p[i + 1].position, t * std::cos(turned) + side * std::sin(turned), p[i + 1].radius, {1.0, 0.0}, v(i + 1)});
        }
    }
    if (pieces == 0) rings.push_back({p.front().position, tangent(0), p.front().radius, {1.0, 0.0}, 0.0});
    add_round_end(rings, p.back(), tangent(pieces == 0 ? 0 : pieces - 1), true, 1.0);
    add_tube(mesh, rings);
}

void add_bspline_tube(TriangleMesh& mesh, const Curve& curve, const std::string& file) {
    constexpr double tolerance = 0.01, most_steps = 4096.0;
    double largest = 0.0;
    for (const ControlPoint& p : curve.points) largest = std::max(largest, p.radius);
    if (largest == 0.0) return;
    const std::size_t pieces = curve.points.size() - 3;
    std::vector<Ring> rings;
    const auto add = [&](const Piece& piece, double t, double v) {
        const glm::dvec4 at = piece.at(t);
        glm::dvec4 slope = piece.slope(t);
        // Where points coincide, the curve may begin or end with the speed 0.
        if (Vec3(slope) == Vec3(0.0)) slope = piece.slope(t < 0.5 ? t + 1e-4 : t - 1e-4);
        const double speed = length_of(Vec3(slope));
        if (speed > 0.0) rings.push_back({Vec3(at), Vec3(slope) / speed, std::max(at.w, 0.0), {1.0, -slope.w / speed}, v});
    };
    for (std::size_t i = 0; i < pieces; ++i) {
        const Piece piece(&curve.points[i]);
        const double steps = std::max(std::ceil(std::sqrt(piece.curvature() / (8.0 * tolerance * largest))), 1.0);
        if (!(steps <= most_steps))
            throw InputError(Location{file, static_cast<int>(curve.line), 1},
                             fmt::format("the curve would need more than {} straight pieces between two points: it is too thin "
                                         "for how it bends",
                                         most_steps));
        for (double k = i == 0 ? 0.0 : 1.0; k <= steps; ++k)
            add(piece, k / steps, (static_cast<double>(i) + k / steps) / static_cast<double>(pieces));
    }
    if (rings.size() < 2) return;
    const auto flat_end = [](Ring ring, double side, double radius) {
        ring.normal = {0.0, side};
        ring.radius = radius;
        return ring;
    };
    std::vector<Ring> closed = {flat_end(rings.front(), -1.0, 0.0), flat_end(rings.front(), -1.0, rings.front().radius)};
    rings.front().begins = true;
    closed.insert(closed.end(), rings.begin(), rings.end());
    closed.push_back(flat_end(rings.back(), 1.0, rings.back().radius));
    closed.back().begins = true;
    closed.push_back(flat_end(rings.back(), 1.0, 0.0));
    add_tube(mesh, closed);
}

}  // namespace neumann
