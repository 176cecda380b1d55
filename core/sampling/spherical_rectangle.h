// Solid angle and uniform sampling of a rectangle seen from a point: Ureña, Fajardo and King, An Area-Preserving Parametrization
// for Spherical Rectangles, 2013.
#pragma once

#include "core/base/vec.h"

namespace neumann {

// corner + s a + t b, s and t in [0, 1], seen from the origin; a and b are perpendicular.
class SphericalRectangle {
public:
    SphericalRectangle(const Vec3& corner, const Vec3& a, const Vec3& b);

    // The solid angle; 0 if the rectangle is seen edge-on. The absolute error is about 10⁻¹⁵, or 10⁻¹⁶ divided by the
    // distance to its plane if that is small, which is the effect of rounding the corner.
    double solid_angle() const { return solid_angle_; }
    // Samples a point of the rectangle; its direction has the pdf 1/solid_angle() per solid angle. solid_angle() must be positive.
    Vec3 sample(const Vec2& u) const;

private:
    Vec3 x_, y_, z_;                     // unit length, along a, along b, and to the plane of the rectangle
    double x0_, x1_, y0_, y1_, height_;  // the rectangle in this frame
    double first_;                       // 2π minus the angles at the corners with x0
    double solid_angle_;
};

}  // namespace neumann
