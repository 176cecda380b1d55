// The GGX distribution of microfacet normals (Trowbridge and Reitz 1975; Walter et al., Microfacet Models for Refraction through
// Rough Surfaces, 2007) with roughness α > 0 in the local frame, one for both tangents or one for each.
#pragma once

#include "core/sampling/warp.h"

#include <algorithm>
#include <cmath>

namespace neumann {

// w, mirrored to the upper side if it is below.
inline Vec3 above(const Vec3& w) { return {w.x, w.y, std::abs(w.z)}; }

class Ggx {
public:
    explicit Ggx(double alpha) : Ggx(Vec2(alpha)) {}
    // α along x and along y.
    explicit Ggx(const Vec2& alpha) : alpha_(alpha), product_(alpha.x * alpha.y), ratio_(alpha.y / alpha.x) {}

    // D(m), sr⁻¹: the area of microfacets with normal m, per solid angle and per area of the surface. The sum is accurate for small
    // α, where 1 + (α² − 1) cos²θ would not be.
    double density(const Vec3& m) const {
        if (m.z <= 0.0) return 0.0;
        const double x = m.x * m.x * ratio_ + m.y * m.y / ratio_ + product_ * m.z * m.z;
        return product_ * inv_pi / (x * x);
    }
    // ∫ D(m) (v·m)⁺ dm, v above the surface: the projected area of the facets without masking. Smith's masking function is
    // G1(v) = v.z / projected_area(v).
    double projected_area(const Vec3& v) const {
        const double x = alpha_.x * v.x, y = alpha_.y * v.y;
        return 0.5 * (v.z + std::sqrt(v.z * v.z + x * x + y * y));
    }
    // Samples a visible normal with the pdf D(m) (v·m)⁺ / projected_area(v), per solid angle of m: Dupuy and Benyoub, Sampling
    // Visible GGX Normals with Spherical Caps, 2023.
    Vec3 sample_visible(const Vec3& v, const Vec2& u) const {
        const Vec3 w = glm::normalize(Vec3(alpha_.x * v.x, alpha_.y * v.y, v.z));
        const double height = (1.0 - u.y) * (1.0 + w.z);                      // z of the cap's point, plus w.z
        const double above = height + (w.x * w.x + w.y * w.y) / (1.0 + w.z);  // z of the cap's point, plus 1
        const double radius = std::sqrt(std::max(above * (2.0 - above), 0.0));
        const Vec2 cap = direction_on_circle(u.x) * radius;
        return glm::normalize(Vec3(alpha_.x * (cap.x + w.x), alpha_.y * (cap.y + w.y), height));
    }
    const Vec2& alpha() const { return alpha_; }

private:
    Vec2 alpha_;
    double product_, ratio_;
};

}  // namespace neumann
