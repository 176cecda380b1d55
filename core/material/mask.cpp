#include "core/material/mask.h"

#include "core/material/bsdf.h"
#include "core/sampling/choose.h"

namespace neumann {

Rgb Mask::eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
    return nested_ ? opacity_(p) * neumann::eval(*nested_, p, wo, wi) : Rgb(0.0);
}

double Mask::pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
    return nested_ ? opacity_(p).r * neumann::pdf(*nested_, p, wo, wi) : 0.0;
}

BsdfSample Mask::sample(const ShadingPoint& p, const Vec3& wo, Vec2 u) const {
    const double opacity = opacity_(p).r;
    if (!choose_first(opacity, u.x)) return {-wo, Rgb(1.0), delta_pdf};
    if (!nested_) return {};
    BsdfSample sampled = neumann::sample(*nested_, p, wo, u);
    sampled.pdf *= opacity;
    return sampled;
}

double Mask::pdf_from_light(const ShadingPoint& p, const Vec3& wi, const Vec3& wo) const {
    return nested_ ? opacity_(p).r * neumann::pdf_from_light(*nested_, p, wi, wo) : 0.0;
}

BsdfSample Mask::sample_from_light(const ShadingPoint& p, const Vec3& wi, Vec2 u) const {
    const double opacity = opacity_(p).r;
    if (!choose_first(opacity, u.x)) return {-wi, Rgb(1.0), delta_pdf};
    if (!nested_) return {};
    BsdfSample sampled = neumann::sample_from_light(*nested_, p, wi, u);
    sampled.pdf *= opacity;
    return sampled;
}

// o a + 1 − o lies between its values at the ends of o.
Rgb Mask::bound(const Rgb& nested) const {
    const Rgb& opacity = opacity_.upper_bound();
    const Rgb opaque = opacity * nested + (1.0 - opacity);
    return opacity_.is_constant() ? opaque : glm::max(opaque, Rgb(1.0));
}
Rgb Mask::largest_albedo() const { return bound(nested_ ? neumann::largest_albedo(*nested_) : Rgb(0.0)); }
Rgb Mask::largest_basic_albedo() const { return bound(nested_ ? neumann::largest_basic_albedo(*nested_) : Rgb(0.0)); }

double Mask::refractive_ratio() const { return nested_ ? neumann::refractive_ratio(*nested_) : 1.0; }
bool Mask::is_constant() const { return opacity_.is_constant() && (!nested_ || neumann::is_constant(*nested_)); }
bool Mask::needs_coordinates() const { return !opacity_.is_constant() || (nested_ && neumann::needs_coordinates(*nested_)); }
bool Mask::is_lawful() const { return !nested_ || neumann::is_lawful(*nested_); }
bool Mask::is_grey() const { return !nested_ || neumann::is_grey(*nested_); }

}  // namespace neumann
