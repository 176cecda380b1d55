// Makes the curves of Mitsuba's shapes `linearcurve` and `bsplinecurve` as closed tubes of triangles.
#pragma once

#include "core/geometry/shape.h"

#include <cstddef>
#include <string>
#include <vector>

namespace neumann {

struct ControlPoint {
    Vec3 position;
    double radius;
};

struct Curve {
    std::vector<ControlPoint> points;
    std::size_t line = 0;  // line of the first point in the file
};

// Reads a file in which a line holds a point and a radius, "x y z r", and an empty line begins the next curve. Throws
// InputError "file:line:column: …" for what is no number, a negative radius, or a curve of fewer than `least` points.
std::vector<Curve> read_curves(const std::string& path, std::size_t least);

// A tube has this many sides, and a straight one the area of the round one: its surface deviates by up to (π/12)²/3 =
// 2.3% of the radius. Joints and ends are cut in steps of 15 degrees, and everything is within 4%.
inline constexpr int sides_of_tubes = 12;

// Adds the tube around straight pieces from point to point, with round joints and round ends.
void add_linear_tube(TriangleMesh& mesh, const Curve& curve);
// Adds the tube around the uniform cubic B-spline of the points, with flat ends. It consists of straight pieces that are within a
// hundredth of the largest radius of the curve. Throws InputError, which begins with `file`, if that takes too many pieces.
void add_bspline_tube(TriangleMesh& mesh, const Curve& curve, const std::string& file);

}  // namespace neumann
