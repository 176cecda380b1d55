#include "core/material/coating.h"

#include "core/material/bsdf.h"
#include "core/material/fresnel.h"
#include "core/sampling/choose.h"

namespace neumann {

Coating::Coating(std::shared_ptr<const Bsdf> nested, double eta, SurfaceFunction absorption, SurfaceFunction specular_reflectance)
    : nested_(std::move(nested)), eta_(eta), absorption_(std::move(absorption)), specular_(std::move(specular_reflectance)) {
    const double s = mean_component(specular_.upper_bound());
    const double d = nested_ ? mean_component(glm::exp(-2.0 * absorption_.upper_bound())) : 0.0;
    specular_share_ = s + d > 0.0 ? s / (s + d) : 1.0;
}

double Coating::fresnel(double cosine) const { return conductor_fresnel(cosine, eta_, 0.0); }

Coating::Inside Coating::inside(const Vec3& w) const {
    const double square = (eta_ - 1.0) * (eta_ + 1.0) + w.z * w.z;
    if (square <= 0.0) return {Vec3(0.0), 0.0};
    return {Vec3(w.x, w.y, std::sqrt(square)) / eta_, 1.0 - fresnel(w.z)};
}

double Coating::compression(const Vec3& w, const Inside& inside) const { return w.z / (eta_ * eta_ * inside.w.z); }

double Coating::specular_probability(double transmitted) const {
    const double s = (1.0 - transmitted) * specular_share_, d = transmitted * (1.0 - specular_share_);
    return s + d > 0.0 ? s / (s + d) : 1.0;
}

Rgb Coating::absorbed(const ShadingPoint& p, double cosine_o, double cosine_i) const {
    return glm::exp(absorption_(p) * -(1.0 / cosine_o + 1.0 / cosine_i));
}

Rgb Coating::eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
    if (!nested_ || wo.z <= 0.0 || wi.z <= 0.0) return Rgb(0.0);
    const Inside o = inside(wo), i = inside(wi);
    if (o.transmitted <= 0.0 || i.transmitted <= 0.0) return Rgb(0.0);
    return neumann::eval(*nested_, p, o.w, i.w) * absorbed(p, o.w.z, i.w.z) * (o.transmitted * i.transmitted / (eta_ * eta_));
}

double Coating::pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
    if (!nested_ || wo.z <= 0.0 || wi.z <= 0.0) return 0.0;
    const Inside o = inside(wo), i = inside(wi);
    if (o.transmitted <= 0.0 || i.transmitted <= 0.0) return 0.0;
    return (1.0 - specular_probability(o.transmitted)) * neumann::pdf(*nested_, p, o.w, i.w) * compression(wi, i);
}

template <class Draw>
BsdfSample Coating::sample_by(const Draw& draw, const ShadingPoint& p, const Vec3& wo, Vec2 u) const {
    if (wo.z <= 0.0) return {};
    const Inside o = inside(wo);
    const double probability = specular_probability(o.transmitted);
    if (choose_first(probability, u.x))
        return {Vec3(-wo.x, -wo.y, wo.z), specular_(p) * ((1.0 - o.transmitted) / probability), delta_pdf};
    if (!nested_) return {};
    const BsdfSample below = draw(o.w, u);
    if (below.pdf == 0.0 || below.wi.z <= 0.0) return {};
    const double square = eta_ * eta_ * below.wi.z * below.wi.z - (eta_ - 1.0) * (eta_ + 1.0);
    if (square <= 0.0) return {};  // reflected inwards
    const Vec3 wi(below.wi.x * eta_, below.wi.y * eta_, std::sqrt(square));
    const double rest = 1.0 - probability;
    const Rgb weight = below.weight * absorbed(p, o.w.z, below.wi.z) * (o.transmitted * (1.0 - fresnel(wi.z)) / rest);
    if (below.pdf == delta_pdf) return {wi, weight, delta_pdf};
    return {wi, weight, rest * below.pdf * wi.z / (eta_ * eta_ * below.wi.z)};
}

BsdfSample Coating::sample(const ShadingPoint& p, const Vec3& wo, Vec2 u) const {
    return sample_by([&](const Vec3& inside, const Vec2& v) { return neumann::sample(*nested_, p, inside, v); }, p, wo, u);
}

double Coating::pdf_from_light(const ShadingPoint& p, const Vec3& wi, const Vec3& wo) const {
    if (!nested_ || wo.z <= 0.0 || wi.z <= 0.0) return 0.0;
    const Inside o = inside(wo), i = inside(wi);
    if (o.transmitted <= 0.0 || i.transmitted <= 0.0) return 0.0;
    return (1.0 - specular_probability(i.transmitted)) * neumann::pdf_from_light(*nested_, p, i.w, o.w) * compression(wo, o);
}

BsdfSample Coating::sample_from_light(const ShadingPoint& p, const Vec3& wi, Vec2 u) const {
    BsdfSample drawn =
        sample_by([&](const Vec3& inside, const Vec2& v) { return neumann::sample_from_light(*nested_, p, inside, v); }, p, wi, u);
    // A tilted mirror below keeps dω', and not dω.
    if (drawn.pdf == delta_pdf) drawn.weight *= compression(wi, inside(wi)) / compression(drawn.wi, inside(drawn.wi));
    return drawn;
}

// With cosθi dωi = η² cosθi' dωi' the albedo is at most s F(cosθo) + (1 − F(cosθo)) a exp(−2 σ), where a is the albedo of the
// material below: the boundary lets at most all light through, whose way through the layer is at least twice the thickness.
Rgb Coating::largest_albedo() const {
    const Rgb below = nested_ ? neumann::largest_albedo(*nested_) : Rgb(0.0);
    const Rgb absorbed = absorption_.is_constant() ? glm::exp(-2.0 * absorption_.upper_bound()) : Rgb(1.0);
    return glm::max(specular_.upper_bound(), below * absorbed);
}

bool Coating::is_constant() const {
    return absorption_.is_constant() && specular_.is_constant() && (!nested_ || neumann::is_constant(*nested_));
}
bool Coating::needs_coordinates() const {
    return !absorption_.is_constant() || !specular_.is_constant() || (nested_ && neumann::needs_coordinates(*nested_));
}
bool Coating::is_grey() const { return absorption_.is_grey() && specular_.is_grey() && (!nested_ || neumann::is_grey(*nested_)); }
bool Coating::is_lawful() const { return !nested_ || neumann::is_lawful(*nested_); }

}  // namespace neumann
