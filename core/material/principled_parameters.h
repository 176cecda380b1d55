// The parameters of Mitsuba's `principled` and `principledthin` (Burley, Physically Based Shading at Disney, 2012; Extending the
// Disney BRDF to a BSDF with Integrated Subsurface Scattering, 2015), and what both make of them.
#pragma once

#include "core/material/surface_function.h"

#include <vector>

namespace neumann {

// At one point.
struct PrincipledValues {
    Rgb base_color{0.5};
    Rgb tint{1.0};  // the base colour of luminance 1
    double roughness = 0.5, anisotropic = 0.0, metallic = 0.0, spec_trans = 0.0, spec_tint = 0.0, sheen = 0.0, sheen_tint = 0.0;
    double flatness = 0.0, clearcoat = 0.0, clearcoat_gloss = 0.0, diff_trans = 0.0, eta = 1.5;

    // α of GGX facets along both tangents, of a roughness that is `scale` times as large.
    Vec2 alpha(double scale = 1.0) const;
    // π fs of the diffuse base, but for its colour: diffuse, with retro-reflection, and flattened as by scattering below the
    // surface. `cos_d` is the cosine between either direction and the one halfway.
    double diffuse(double cos_o, double cos_i, double cos_d) const;
    Rgb sheen_color(double cos_d) const;
    // Schlick's share of a dielectric whose reflection towards the normal is tinted.
    Rgb tinted_fresnel(double cosine) const;
};

// R0 + (1 − R0) (1 − cosθ)⁵, with the angle inside where η < 1.
Rgb schlick(const Rgb& R0, double cosine, double eta);

struct PrincipledParameters {
    SurfaceFunction base_color = Rgb(0.5), roughness = Rgb(0.5), anisotropic = Rgb(0.0), metallic = Rgb(0.0), spec_trans = Rgb(0.0);
    SurfaceFunction spec_tint = Rgb(0.0), sheen = Rgb(0.0), sheen_tint = Rgb(0.0), flatness = Rgb(0.0), clearcoat = Rgb(0.0);
    SurfaceFunction clearcoat_gloss = Rgb(0.0), diff_trans = Rgb(0.0), eta = Rgb(1.5);

    PrincipledValues operator()(const ShadingPoint& p) const;
    bool is_constant() const;
    bool is_isotropic() const { return anisotropic.is_constant() && anisotropic.upper_bound().r == 0.0; }
    bool is_grey() const;
    // The values, or where they vary those at the ends of their ranges, between which the albedo is linear in most of them. Half
    // the roughness is among them.
    std::vector<PrincipledValues> extremes() const;
};

}  // namespace neumann
