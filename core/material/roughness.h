// Microfacets whose roughness may vary over a surface.
#pragma once

#include "core/material/surface_function.h"

#include <algorithm>

namespace neumann {

// `Microfacets` is Ggx or Beckmann.
template <class Microfacets>
class Roughness {
public:
    Roughness(const Microfacets& constant)
        : alpha_u_(Rgb(constant.alpha().x)), alpha_v_(Rgb(constant.alpha().y)), bound_(constant) {}
    // Values below 10⁻⁴ are replaced by 10⁻⁴, as in Mitsuba.
    Roughness(SurfaceFunction alpha_u, SurfaceFunction alpha_v)
        : alpha_u_(std::move(alpha_u)),
          alpha_v_(std::move(alpha_v)),
          bound_(microfacets(alpha_u_.upper_bound(), alpha_v_.upper_bound())) {}

    Microfacets operator()(const ShadingPoint& p) const { return is_constant() ? bound_ : microfacets(alpha_u_(p), alpha_v_(p)); }
    bool is_constant() const { return alpha_u_.is_constant() && alpha_v_.is_constant(); }
    bool is_isotropic() const { return is_constant() && bound_.alpha().x == bound_.alpha().y; }
    // The smaller α of the two tangents, by the bounds over the surface.
    double alpha() const { return std::min(bound_.alpha().x, bound_.alpha().y); }

private:
    static Microfacets microfacets(const Rgb& u, const Rgb& v) { return Microfacets(glm::max(Vec2(u.r, v.r), Vec2(1e-4))); }

    SurfaceFunction alpha_u_, alpha_v_;
    Microfacets bound_;
};

}  // namespace neumann
