// Bidirectional scattering distribution functions fs(p, ωi → ωo), in 1/sr. Directions are in the local frame, of unit length and
// pointing away from the surface; pdfs are per solid angle.
//
// eval() and pdf() do not include delta lobes (`Lobe::Kind::specular`); sample() returns them with the pdf ∞ (delta_pdf).
#pragma once

#include "core/material/blend.h"
#include "core/material/coating.h"
#include "core/material/conductor.h"
#include "core/material/dielectric.h"
#include "core/material/diffuse.h"
#include "core/material/mask.h"
#include "core/material/null.h"
#include "core/material/perturbed_normal.h"
#include "core/material/phong.h"
#include "core/material/plastic.h"
#include "core/material/principled.h"
#include "core/material/principled_thin.h"
#include "core/material/retroreflector.h"
#include "core/material/rough_conductor.h"
#include "core/material/rough_dielectric.h"
#include "core/material/rough_plastic.h"
#include "core/material/thin_dielectric.h"
#include "core/material/ward.h"

#include <optional>
#include <type_traits>
#include <variant>

namespace neumann {

// A closed set: to add a material, add a file beside diffuse.h and a name here. A Bsdf is for one side of a surface: ωo is always
// above it, ωo.z > 0, and light is transmitted if ωi.z < 0. The other side of glass is another Bsdf. Radiance is L and not L/n²: it
// is n² times as large within glass.
struct Bsdf
    : std::variant<Diffuse, Conductor, RoughConductor<Ggx>, RoughConductor<Beckmann>, Dielectric, ThinDielectric,
                   RoughDielectric<Ggx>, RoughDielectric<Beckmann>, Plastic, RoughPlastic<Ggx>, RoughPlastic<Beckmann>, Principled,
                   PrincipledThin, Null, Phong, Ward, Retroreflector, RoughRetroreflector, Mask, Blend, Coating, PerturbedNormal> {
    using variant::variant;
};

// std::visit for the innermost loops: with so many materials std::visit would call each through a table, but the simplest one
// should be inlined.
template <class F>
auto visit_fast(const Bsdf& bsdf, const F& f) {
    if (const auto* diffuse = std::get_if<Diffuse>(&bsdf)) return f(*diffuse);
    return std::visit(f, static_cast<const Bsdf::variant&>(bsdf));
}
inline Rgb eval(const Bsdf& bsdf, const ShadingPoint& p, const Vec3& wo, const Vec3& wi) {
    return visit_fast(bsdf, [&](const auto& b) { return b.eval(p, wo, wi); });
}
inline double pdf(const Bsdf& bsdf, const ShadingPoint& p, const Vec3& wo, const Vec3& wi) {
    return visit_fast(bsdf, [&](const auto& b) { return b.pdf(p, wo, wi); });
}
inline BsdfSample sample(const Bsdf& bsdf, const ShadingPoint& p, const Vec3& wo, const Vec2& u) {
    return visit_fast(bsdf, [&](const auto& b) { return b.sample(p, wo, u); });
}
// Samples ωo for paths from lights, for which ωi is given: by sample() and pdf() with the directions exchanged, if
// these find all ωo to which light goes. Only the weights of delta lobes are used: fs(ωi → ωo) |cosθo| / pdf with R's
// fs, the cosines about the normal that mirrors.
inline BsdfSample sample_from_light(const Bsdf& bsdf, const ShadingPoint& p, const Vec3& wi, const Vec2& u) {
    return visit_fast(bsdf, [&](const auto& b) {
        if constexpr (requires { b.sample_from_light(p, wi, u); })
            return b.sample_from_light(p, wi, u);
        else
            return b.sample(p, wi, u);
    });
}
inline double pdf_from_light(const Bsdf& bsdf, const ShadingPoint& p, const Vec3& wi, const Vec3& wo) {
    return visit_fast(bsdf, [&](const auto& b) {
        if constexpr (requires { b.pdf_from_light(p, wi, wo); })
            return b.pdf_from_light(p, wi, wo);
        else
            return b.pdf(p, wi, wo);
    });
}
// An upper bound on ∫ fs |cosθ| dω over all points and directions, for each channel.
inline Rgb largest_albedo(const Bsdf& bsdf) {
    return std::visit([](const auto& b) { return b.largest_albedo(); }, bsdf);
}
// The same for basic radiance L/n²; above 1 if the material does not conserve energy.
inline Rgb largest_basic_albedo(const Bsdf& bsdf) {
    return std::visit(
        [](const auto& b) {
            if constexpr (requires { b.largest_basic_albedo(); })
                return b.largest_basic_albedo();
            else
                return b.largest_albedo();
        },
        bsdf);
}
// Whether light is transmitted from the other side.
inline bool transmits(const Bsdf& bsdf) {
    return std::visit(
        [](const auto& b) {
            if constexpr (requires { b.transmits(); })
                return b.transmits();
            else
                return false;
        },
        bsdf);
}
// The refractive index beyond a boundary between two media, which may be a part of the material, divided by that on
// this side; 1 for other materials.
inline double refractive_ratio(const Bsdf& bsdf) {
    return std::visit(
        [](const auto& b) {
            if constexpr (requires { b.refractive_ratio(); })
                return b.refractive_ratio();
            else
                return 1.0;
        },
        bsdf);
}
// Whether the material is known to have delta lobes alone, so that eval() is 0.
inline bool is_delta_only(const Bsdf& bsdf) {
    return std::visit(
        []<class B>(const B&) {
            return std::is_same_v<B, Conductor> || std::is_same_v<B, Dielectric> || std::is_same_v<B, ThinDielectric> ||
                   std::is_same_v<B, Null> || std::is_same_v<B, Retroreflector>;
        },
        static_cast<const Bsdf::variant&>(bsdf));
}
inline Lobe lobe(const Bsdf& bsdf) {
    return std::visit([](const auto& b) { return b.lobe(); }, bsdf);
}

// For a material that sends light in two directions at most, among which sample() chooses by the first number: the probability of
// the first one, which numbers below it choose.
inline std::optional<double> choice(const Bsdf& bsdf, const Vec3& wo) {
    return std::visit(
        [&](const auto& b) -> std::optional<double> {
            if constexpr (requires { b.choice(wo); })
                return b.choice(wo);
            else
                return std::nullopt;
        },
        bsdf);
}

// True if the material conserves energy, up to its largest albedo, and is reciprocal; false if it guarantees neither.
inline bool is_lawful(const Bsdf& bsdf) {
    return std::visit(
        [](const auto& b) {
            if constexpr (requires { b.is_lawful(); })
                return b.is_lawful();
            else
                return true;
        },
        bsdf);
}

// fs(p, ωi → ωo) = ρ(p) g(ωi, ωo): ρ, and the material with ρ = 1. If fs is not such a product, 1 and the material itself.
inline Rgb reflectance(const Bsdf& bsdf, const ShadingPoint& p) {
    return std::visit([&](const auto& b) { return b.reflectance(p); }, bsdf);
}
inline Bsdf white(const Bsdf& bsdf) {
    return std::visit([](const auto& b) -> Bsdf { return b.white(); }, bsdf);
}

// Whether fs is known to be constant over a surface.
inline bool is_constant(const Bsdf& bsdf) {
    return std::visit([](const auto& b) { return b.is_constant(); }, bsdf);
}
// Whether fs depends on texture coordinates or tangents.
inline bool needs_coordinates(const Bsdf& bsdf) {
    return std::visit(
        [](const auto& b) {
            if constexpr (requires { b.needs_coordinates(); }) return b.needs_coordinates();
            return !b.is_constant();
        },
        bsdf);
}
// Whether fs(p, ωi → ωo) = ρ(p) g(ωi, ωo), with ρ from reflectance() and g from white().
inline bool factors(const Bsdf& bsdf) { return is_constant(white(bsdf)); }
// Whether all channels are known to be alike.
inline bool is_grey(const Bsdf& bsdf) {
    return std::visit([](const auto& b) { return b.is_grey(); }, bsdf);
}

}  // namespace neumann
