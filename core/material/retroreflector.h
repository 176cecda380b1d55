// Reflects light back to where it came from, like a road sign: fs(ωi → ωo) |cos θi| = ρ δ(ωi − ωo). One-sided. A rough
// retroreflector spreads light around that direction as a rough mirror does around the mirror direction:
//
//     fs(ωi → ωo) = fr(M ωi → ωo),   M ωi the mirror image of ωi,  fr that of RoughConductor,
//
// which is reciprocal because fr is: ωi + M ωo is the mirror image of ωo + M ωi, and the distribution of facets is symmetric about
// the normal.
#pragma once

#include "core/material/rough_conductor.h"

namespace neumann {

class Retroreflector {
public:
    explicit Retroreflector(SurfaceFunction reflectance) : reflectance_(std::move(reflectance)) {}

    Rgb eval(const ShadingPoint&, const Vec3&, const Vec3&) const { return Rgb(0.0); }
    double pdf(const ShadingPoint&, const Vec3&, const Vec3&) const { return 0.0; }
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, const Vec2&) const {
        if (wo.z <= 0.0) return {};
        return {wo, reflectance_(p), delta_pdf};
    }
    Rgb reflectance(const ShadingPoint& p) const { return reflectance_(p); }
    Retroreflector white() const { return Retroreflector(Rgb(1.0)); }
    Rgb largest_albedo() const { return reflectance_.upper_bound(); }
    bool is_constant() const { return reflectance_.is_constant(); }
    bool is_grey() const { return reflectance_.is_grey(); }
    Lobe lobe() const { return {Lobe::Kind::specular, 0.0}; }

private:
    SurfaceFunction reflectance_;
};

class RoughRetroreflector {
public:
    RoughRetroreflector(const Ggx& facets, SurfaceFunction reflectance) : mirror_(facets, {}, std::move(reflectance)) {}

    Rgb eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const { return mirror_.eval(p, wo, image(wi)); }
    double pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const { return mirror_.pdf(p, wo, image(wi)); }
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, const Vec2& u) const {
        BsdfSample sampled = mirror_.sample(p, wo, u);
        sampled.wi = image(sampled.wi);
        return sampled;
    }
    Rgb reflectance(const ShadingPoint& p) const { return mirror_.reflectance(p); }
    RoughRetroreflector white() const { return RoughRetroreflector(mirror_.white()); }
    Rgb largest_albedo() const { return mirror_.largest_albedo(); }
    bool is_constant() const { return mirror_.is_constant(); }
    bool is_grey() const { return mirror_.is_grey(); }
    Lobe lobe() const { return mirror_.lobe(); }

private:
    explicit RoughRetroreflector(RoughConductor<Ggx> mirror) : mirror_(std::move(mirror)) {}
    static Vec3 image(const Vec3& w) { return {-w.x, -w.y, w.z}; }

    RoughConductor<Ggx> mirror_;
};

}  // namespace neumann
