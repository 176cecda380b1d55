// A material with a perturbed normal n': Mitsuba's `normalmap` and `bumpmap`. With primes for directions in the frame of n', and f'
// the nested material,
//
//     fs(ωi → ωo) |cosθi| = f'(ωi' → ωo') |cosθi'| G(ωi)    if cosθ and cosθ' have the same sign, otherwise 0.
//
// G is a shadowing function: Conty Estevez, Lecocq and Stein, A Microfacet-Based Shadowing Function to Solve the Bump Terminator
// Problem, Ray Tracing Gems, 2019. A normal that faces away from ωo is mirrored at the surface's normal: Schüssler et al.,
// Microfacet-based Normal Mapping for Robust Monte Carlo Path Tracing, 2017.
//
// fs is not reciprocal. The albedo for ωo is at most that of f', which bounds R in L^∞. But of light from a single, grazing
// direction ωi a diffuse f' reflects up to 2√2 cosτ (1 + cosτ) ρ, where τ is the tilt of n'; without G there is no bound.
#pragma once

#include "core/material/bsdf_sample.h"
#include "core/material/lobe.h"
#include "core/material/surface_function.h"

#include <functional>
#include <memory>

namespace neumann {

struct Bsdf;

// n' of a height field h(u, v) over the surface, from (∂h/∂u, ∂h/∂v): along (∂p/∂u + n ∂h/∂u) × (∂p/∂v + n ∂h/∂v), the tangents in
// the plane across n, and on the side of the geometric normal. In the frame of the front, of any length.
Vec3 bump_normal(const ShadingPoint& p, const Vec2& slope);

class PerturbedNormal {
public:
    // n', of any length, in the frame of the front.
    using Normal = std::function<Vec3(const ShadingPoint&)>;
    struct Options {
        bool flip_invalid_normals = true;
        bool use_shadowing_function = true;
        // The material is on the back, and sees the perturbed surface from behind.
        bool from_behind = false;
    };

    PerturbedNormal(Normal normal, std::shared_ptr<const Bsdf> nested, const Options& options)
        : normal_(std::move(normal)), nested_(std::move(nested)), options_(options) {}

    Rgb eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const;
    double pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const;
    BsdfSample sample(const ShadingPoint& p, const Vec3& wo, const Vec2& u) const;
    // Which of the two normals a delta lobe mirrors at depends on ωo, so that light from ωi may leave by both: both are tried.
    double pdf_from_light(const ShadingPoint& p, const Vec3& wi, const Vec3& wo) const;
    BsdfSample sample_from_light(const ShadingPoint& p, const Vec3& wi, const Vec2& u) const;
    Rgb reflectance(const ShadingPoint& p) const;
    PerturbedNormal white() const;
    Rgb largest_albedo() const;
    bool is_constant() const { return false; }
    bool is_lawful() const { return false; }
    bool transmits() const;
    bool is_grey() const;
    Lobe lobe() const;

private:
    // The frame of n' in the frame of n, and the same point with that frame.
    struct Perturbed {
        Frame frame;
        ShadingPoint p;
    };
    Vec3 normal(const ShadingPoint& p) const;  // not mirrored, nor normalized
    bool is_mirrored(const Vec3& normal, const Vec3& wo) const;
    Perturbed perturbed(const ShadingPoint& p, Vec3 normal, bool mirrored) const;
    Perturbed perturbed(const ShadingPoint& p, const Vec3& wo) const;
    bool may_leave_by_both(const ShadingPoint& p, const Vec3& wi) const;
    double shadowing(const Vec3& normal, const Vec3& wi) const;

    Normal normal_;
    std::shared_ptr<const Bsdf> nested_;
    Options options_;
};

}  // namespace neumann
