// The parameters of Mitsuba's `principled` and `principledthin` (Burley, Physically Based Shading at Disney, 2012; Extending the
// Disney BRDF to a BSDF with Integrated Subsurface Scattering, 2015), and what both make of them.
#pragma once

#include "core/material/surface_function.h"

#include <vector>

namespace neumann {

// The values at one point.
struct PrincipledValues {
    Rgb base_color{0.5};
    Rgb tint{1.0};  // the base colour of luminance 1
    double roughness = 0.5, anisotropic = 0.0, metallic = 0.0, spec_trans = 0.0, spec_tint = 0.0, sheen = 0.0, sheen_tint = 0.0;
    double flatness = 0.0, clearcoat = 0.0, clearcoat_gloss = 0.0, diff_trans = 0.0, eta = 1.5;

    // α of GGX facets along both tangents, for `scale` times the roughness.
    Vec2 alpha(double scale = 1.0) const;
    // π fs of the diffuse base without its colour: diffuse, with retro-reflection, and flattened to imitate subsurface scattering.
    // `cos_d` is the cosine between either direction and the half vector.
    double diffuse(double cos_o, double cos_i, double cos_d) const;
    Rgb sheen_color(double cos_d) const;
    // Schlick's Fresnel reflectance of a dielectric whose reflectance at normal incidence is tinted.
    Rgb tinted_fresnel(double cosine) const;
};

// R0 + (1 − R0) (1 − cosθ)⁵; if η < 1, θ is the angle of refraction.
Rgb schlick(const Rgb& R0, double cosine, double eta);

struct PrincipledParameters {
    SurfaceFunction base_color = Rgb(0.5), roughness = Rgb(0.5), anisotropic = Rgb(0.0), metallic = Rgb(0.0), spec_trans = Rgb(0.0);
    SurfaceFunction spec_tint = Rgb(0.0), sheen = Rgb(0.0), sheen_tint = Rgb(0.0), flatness = Rgb(0.0), clearcoat = Rgb(0.0);
    SurfaceFunction clearcoat_gloss = Rgb(0.0), diff_trans = Rgb(0.0), eta = Rgb(1.5);

    PrincipledValues operator()(const ShadingPoint& p) const;
    bool is_constant() const;
    bool is_isotropic() const { return anisotropic.is_constant() && anisotropic.upper_bound().r == 0.0; }
    bool is_grey() const;
    // All combinations of the values at the ends of their ranges; the albedo is linear in most of them in between. Half
    // the roughness is included.
    std::vector<PrincipledValues> extremes() const;
};

}  // namespace neumann
