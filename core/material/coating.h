// A smooth dielectric layer over another material (`coating` of Mitsuba 0.6, after Weidlich and Wilkie, Arbitrarily Layered
// Micro-Facet Surfaces, 2007). With η the refractive index of the layer relative to the outside, F Fresnel's share, ω' the
// direction into which ω is refracted, σ the absorption of the layer times its thickness and fs' the material below,
//
//     fs(ωi → ωo) = s F δ(ωi − M ωo) / cosθi
//                 + (1 − F(cosθi)) (1 − F(cosθo)) exp(−σ (1/cosθi' + 1/cosθo')) fs'(ωi' → ωo') / η².
//
// Light that the layer reflects inwards is lost. The layer has two faces: it reflects where nothing lies below it, too.
#pragma once

#include "core/material/bsdf_sample.h"
#include "core/material/lobe.h"
#include "core/material/surface_function.h"

#include <memory>

namespace neumann {

struct Bsdf;

class Coating {
public:
    // `nested`: the material of this side, which only reflects; null if it absorbs.
    Coating(std::shared_ptr<const Bsdf> nested, double eta, SurfaceFunction absorption, SurfaceFunction specular_reflectance);

    Rgb eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const;
    double pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const;
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, Vec2 u) const;
    double pdf_from_light(const ShadingPoint& p, const Vec3& wi, const Vec3& wo) const;
    BsdfSample sample_from_light(const ShadingPoint& p, const Vec3& wi, Vec2 u) const;
    Rgb reflectance(const ShadingPoint&) const { return Rgb(1.0); }
    const Coating& white() const { return *this; }
    Rgb largest_albedo() const;
    bool is_constant() const;
    bool needs_coordinates() const;
    bool is_grey() const;
    bool is_lawful() const;
    Lobe lobe() const { return {Lobe::Kind::specular, 0.0}; }

private:
    // A direction below the boundary, and the share of light that gets there: 0 if all is reflected.
    struct Inside {
        Vec3 w;
        double transmitted;
    };
    Inside inside(const Vec3& w) const;
    // dω'/dω, as cosθ dω = η² cosθ' dω'.
    double compression(const Vec3& w, const Inside& inside) const;
    double fresnel(double cosine) const;
    // The probability of sampling the boundary, which lets this share through.
    double specular_probability(double transmitted) const;
    template <class Draw>
    BsdfSample sample_by(const Draw& draw, const ShadingPoint& p, const Vec3& wo, Vec2 u) const;
    Rgb absorbed(const ShadingPoint& p, double cosine_o, double cosine_i) const;

    std::shared_ptr<const Bsdf> nested_;
    double eta_;
    SurfaceFunction absorption_, specular_;
    double specular_share_;
};

}  // namespace neumann
