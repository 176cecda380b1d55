// Curves: tubes of triangles, closed, of the area of round ones, and as near to them as the manual says.
#include "core/reader/convert_scene.h"
#include "tests/reader/xml_scene_files.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace neumann::xml_curves_test {

constexpr double pi = std::numbers::pi;
// Tubes have 12 sides. Their edges are this much farther from the axis than the round surface is, so that a ring has the perimeter
// of the circle, and the middles of the sides this much nearer: 1.2% and 2.3%.
const double widened = (pi / 12.0) / std::sin(pi / 12.0), flattened = (pi / 12.0) / std::tan(pi / 12.0);

class XmlCurves : public XmlTest {
protected:
    TriangleMesh tube(const std::string& type, const std::string& points, const std::string& inside = "") const {
        write("hair.txt", points);
        return std::get<TriangleMesh>(
            read("<shape type='" + type + "'><string name='filename' value='hair.txt'/>" + inside + "</shape>").shapes.at(0));
    }
};

double area(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (const auto& t : mesh.triangles)
        sum += 0.5 * glm::length(glm::cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]));
    return sum;
}

// By the divergence theorem, positive if all triangles face outwards.
double volume(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (const auto& t : mesh.triangles)
        sum += glm::dot(mesh.vertices[t[0]], glm::cross(mesh.vertices[t[1]], mesh.vertices[t[2]])) / 6.0;
    return sum;
}

// Each edge is that of two triangles, in opposite directions; vertices in the same place count as one.
bool is_closed(const TriangleMesh& mesh) {
    const auto key = [&](std::uint32_t i) {
        const Vec3 p = mesh.vertices[i] * 1e9;
        return std::array{std::llround(p.x), std::llround(p.y), std::llround(p.z)};
    };
    std::map<std::pair<std::array<long long, 3>, std::array<long long, 3>>, int> edges;
    for (const auto& t : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto a = key(t[i]), b = key(t[(i + 1) % 3]);
            if (a == b) return false;  // a triangle without area
            ++edges[{a, b}];
            --edges[{b, a}];
        }
    return std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 0; });
}

// What is between two rings of a straight tube, which is a frustum of a pyramid: its volume, and the area of its sides.
struct Frustum {
    double volume, area;
};
Frustum frustum(double one, double other, double height) {
    constexpr double sine = 0.5;  // of the angle of a side, 30 degrees
    const double a = 6.0 * sine * std::pow(one * widened, 2.0), b = 6.0 * sine * std::pow(other * widened, 2.0);
    return {height / 3.0 * (a + b + std::sqrt(a * b)), pi * (one + other) * std::hypot(height, flattened * (one - other))};
}
// Half a ball, cut by rings in steps of 15 degrees.
Frustum half_ball(double radius) {
    Frustum all{};
    for (int i = 0; i < 6; ++i) {
        const double from = pi / 12.0 * i, to = pi / 12.0 * (i + 1);
        const Frustum part =
            frustum(radius * std::cos(from), i == 5 ? 0.0 : radius * std::cos(to), radius * (std::sin(to) - std::sin(from)));
        all.volume += part.volume;
        all.area += part.area;
    }
    return all;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::distance(p, a + (b - a) * t);
}

// A straight piece is a cylinder with two half balls, all of them of flat triangles, whose area and volume are known up to
// rounding.
TEST_F(XmlCurves, StraightPiece) {
    const TriangleMesh mesh = tube("linearcurve", "0 0 0 0.5\n0 0 3 0.5\n");
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_NEAR(area(mesh), frustum(0.5, 0.5, 3.0).area + 2.0 * half_ball(0.5).area, 1e-12);
    EXPECT_NEAR(volume(mesh), frustum(0.5, 0.5, 3.0).volume + 2.0 * half_ball(0.5).volume, 1e-12);
    for (const Vec3& v : mesh.vertices) EXPECT_LE(distance_to_segment(v, {0, 0, 0}, {0, 0, 3}), 0.5 * widened * (1.0 + 1e-12));
    for (const auto& t : mesh.triangles) {
        const Vec3 middle = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
        // Within 4%, as curves.h says.
        EXPECT_GE(distance_to_segment(middle, {0, 0, 0}, {0, 0, 3}), 0.5 * 0.96);
    }
    double sides = 0.0;  // the part that is a prism has the area of the cylinder
    for (const auto& t : mesh.triangles) {
        const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        if (std::min({a.z, b.z, c.z}) >= -1e-12 && std::max({a.z, b.z, c.z}) <= 3.0 + 1e-12)
            sides += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    EXPECT_NEAR(sides, 2.0 * pi * 0.5 * 3.0, 1e-12);
    // Normals of a cylinder, and of a ball at the ends: (cos, sin) there, beside (w cos, sin) of a ring that is widened by w. The
    // cosine of what is between them is least at 2 √w / (w + 1).
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vec3 out = mesh.vertices[i] - Vec3(0.0, 0.0, std::clamp(mesh.vertices[i].z, 0.0, 3.0));
        EXPECT_GE(glm::dot(mesh.normals[i], glm::normalize(out)), 2.0 * std::sqrt(widened) / (widened + 1.0) - 1e-12);
    }
}

// Vertices and middles of triangles are as near to the round surface as is said; bends of all angles, and thicker and thinner.
TEST_F(XmlCurves, BentPiecesAreWithinTheStatedError) {
    const std::vector<Vec3> corners = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 1}, {2, 2, 1.2}, {5, 2, 1.2}};
    std::string text;
    for (const Vec3& p : corners) text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + " 0.1\n";
    const TriangleMesh mesh = tube("linearcurve", text);
    EXPECT_TRUE(is_closed(mesh));
    const auto away = [&](const Vec3& p) {
        double least = 1e9;
        for (std::size_t i = 0; i + 1 < corners.size(); ++i)
            least = std::min(least, distance_to_segment(p, corners[i], corners[i + 1]));
        return least;
    };
    double nearest = 1e9, farthest = 0.0;
    for (const Vec3& v : mesh.vertices) farthest = std::max(farthest, away(v));
    for (const auto& t : mesh.triangles) {
        const Vec3 middle = (mesh.vertices[t[0]] + mesh.vertices[t[1]]) / 2.0;
        farthest = std::max(farthest, away(middle));
        // Within a bend, rings cross each other.
        bool in_bend = false;
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) in_bend = in_bend || glm::distance(middle, corners[i]) < 0.25;
        const bool at_end = glm::distance(middle, corners.front()) < 0.2 || glm::distance(middle, corners.back()) < 0.2;
        if (!in_bend && !at_end) nearest = std::min(nearest, away(middle));
    }
    EXPECT_LE(farthest, 0.1 * widened * (1.0 + 1e-9));
    EXPECT_GE(nearest, 0.1 * flattened * (1.0 - 1e-9));
}

// The volume of the polyhedron, a pyramid of twelve sides on half a ball, up to rounding.
TEST_F(XmlCurves, ConesTaperToAPoint) {
    const TriangleMesh mesh = tube("linearcurve", "0 0 0 1\n0 0 2 0\n");
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_NEAR(volume(mesh), frustum(1.0, 0.0, 2.0).volume + half_ball(1.0).volume, 1e-12);
    double highest = 0.0;
    for (const Vec3& v : mesh.vertices) highest = std::max(highest, v.z);
    EXPECT_EQ(highest, 2.0);
}

// Equally spaced points on a line: the spline runs along it at constant speed, between the second and the last point but one.
TEST_F(XmlCurves, SplineAlongALine) {
    const TriangleMesh mesh = tube("bsplinecurve", "0 0 0 0.25\n0 0 1 0.25\n0 0 2 0.25\n0 0 3 0.25\n0 0 4 0.25\n");
    EXPECT_TRUE(is_closed(mesh));
    const Bounds bounds = bounds_of(mesh);
    EXPECT_NEAR(bounds.low.z, 1.0, 1e-12);
    EXPECT_NEAR(bounds.high.z, 3.0, 1e-12);
    const double polygon = 0.5 * 12.0 * std::pow(0.25 * widened, 2.0) * std::sin(2.0 * pi / 12.0);
    EXPECT_NEAR(volume(mesh), 2.0 * polygon, 1e-12);
    EXPECT_NEAR(area(mesh), 2.0 * pi * 0.25 * 2.0 + 2.0 * polygon, 1e-12);
}

// A cubic through B-spline points of a parabola x = t, y = t² is that parabola, shifted by 1/3 (the third of the second
// difference).
TEST_F(XmlCurves, SplineOfAParabola) {
    std::string text;
    for (int i = -1; i <= 4; ++i) text += std::to_string(i) + " " + std::to_string(i * i) + " 0 0.01\n";
    const TriangleMesh mesh = tube("bsplinecurve", text);
    EXPECT_TRUE(is_closed(mesh));
    // The distance from the parabola y = x² + 1/3, by Newton's method. Straight pieces are within a hundredth of the radius of it;
    // 0.1% is left for rings that do not stand exactly across a piece.
    const auto away = [](const Vec3& p) {
        double t = p.x;
        for (int i = 0; i < 50; ++i) {
            const double f = (t - p.x) + 2.0 * t * (t * t + 1.0 / 3.0 - p.y), g = 1.0 + 6.0 * t * t + 2.0 / 3.0 - 2.0 * p.y;
            t -= f / g;
        }
        return std::sqrt((t - p.x) * (t - p.x) + std::pow(t * t + 1.0 / 3.0 - p.y, 2.0) + p.z * p.z);
    };
    for (const auto& t : mesh.triangles) {
        const Vec3 middle = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
        EXPECT_LE(away(middle), 0.01 * (widened + 0.01));
        const bool is_side = middle.x > 0.1 && middle.x < 2.9;
        EXPECT_GE(away(middle), is_side ? 0.01 * (flattened - 0.01 - 0.001) : 0.0);
    }
}

// Points in the same place at the ends, as files have them so that the spline reaches its last point.
TEST_F(XmlCurves, SplineThatBeginsAtItsFirstPoint) {
    const TriangleMesh mesh = tube("bsplinecurve", "1 0 0 0.1\n1 0 0 0.1\n1 0 0 0.1\n3 0 0 0.1\n5 0 0 0.1\n5 0 0 0.1\n5 0 0 0.1\n");
    EXPECT_TRUE(is_closed(mesh));
    const Bounds bounds = bounds_of(mesh);
    EXPECT_NEAR(bounds.low.x, 1.0, 1e-12);
    EXPECT_NEAR(bounds.high.x, 5.0, 1e-12);
}

// As in Mitsuba the radii are not scaled.
TEST_F(XmlCurves, ToWorldMovesThePoints) {
    const TriangleMesh mesh = tube("bsplinecurve", "0 0 0 0.25\n0 0 1 0.25\n0 0 2 0.25\n0 0 3 0.25\n",
                                   "<transform name='to_world'><scale value='10'/></transform>");
    double high = 0.0, wide = 0.0;
    for (const Vec3& v : mesh.vertices) {
        high = std::max(high, v.z);
        wide = std::max(wide, std::hypot(v.x, v.y));
    }
    EXPECT_NEAR(high, 20.0, 1e-12);
    EXPECT_NEAR(wide, 0.25 * widened, 1e-12);
    const TriangleMesh turned =
        tube("bsplinecurve", "0 0 0 1\n0 0 1 1\n0 0 2 1\n0 0 3 1\n", "<boolean name='flip_normals' value='true'/>");
    EXPECT_LT(volume(turned), 0.0);
}

TEST_F(XmlCurves, SeveralCurvesAndEmptyLines) {
    const TriangleMesh one = tube("linearcurve", "0 0 0 0.5\n0 0 3 0.5"),
                       two = tube("linearcurve", "\n\n0 0 0 0.5\n0 0 3 0.5\n \n\n5 0 0 0.5\r\n5 0 3 0.5\r\n\r\n");
    EXPECT_EQ(two.triangles.size(), 2 * one.triangles.size());
    EXPECT_NEAR(area(two), 2.0 * area(one), 1e-12);
}

// The file comes along with a scene that is converted.
TEST_F(XmlCurves, AreConverted) {
    const std::string points = "0 0 0 0.5\n0 0 3 0.5\n";
    write("locks/hair.txt", points);
    write("scene.xml", scene("<shape type='linearcurve'><string name='filename' value='locks/hair.txt'/></shape>"));
    const ConvertedScene converted = convert_scene(path("scene.xml"));
    EXPECT_EQ(converted.files, (std::map<std::string, std::string>{{"meshes/hair.txt", points}}));
    EXPECT_NE(converted.xml.find("<shape type=\"linearcurve\">"), std::string::npos);
    EXPECT_NE(converted.xml.find("value=\"meshes/hair.txt\""), std::string::npos);
}

}  // namespace neumann::xml_curves_test
