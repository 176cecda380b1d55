#include "core/material/principled.h"

#include "core/material/fresnel.h"
#include "core/material/ggx.h"
#include "core/material/gtr1.h"
#include "core/material/measured_albedo.h"
#include "core/sampling/choose.h"

#include <algorithm>

namespace neumann {

namespace {

const Ggx coat_masking(0.25);

double coat_alpha(double gloss) { return 0.1 + gloss * (0.001 - 0.1); }
double glass_share(const PrincipledValues& v) { return (1.0 - v.metallic) * v.spec_trans; }
double diffuse_share(const PrincipledValues& v) { return (1.0 - v.metallic) * (1.0 - v.spec_trans); }

// The facet's normal, above the surface.
Vec3 normal_between(const Vec3& wo, const Vec3& wi, double eta) {
    const Vec3 m = wi.z > 0.0 ? wo + wi : wo + eta * wi;
    return glm::normalize(m.z < 0.0 ? -m : m);
}

}  // namespace

struct Principled::Probabilities {
    double diffuse, coat, reflection, transmission;
};

Principled::Principled(std::shared_ptr<const PrincipledParameters> parameters, Side side)
    : parameters_(std::move(parameters)), outside_(side == Side::outside) {
    for (const PrincipledValues& v : parameters_->extremes()) {
        const PrincipledValues here = on_this_side(v);
        largest_albedo_ = glm::max(
            largest_albedo_,
            measured_albedo(parameters_->is_isotropic(), [&](const Vec3& wo, const Vec2& u) { return sample(here, wo, u); }));
    }
}

Lobe Principled::lobe() const {
    const PrincipledValues v = parameters_->extremes().front();
    const Vec2 alpha = v.alpha();
    const double sharpest = std::min(alpha.x, alpha.y);
    return {Lobe::Kind::rough, v.clearcoat > 0.0 ? std::min(sharpest, coat_alpha(v.clearcoat_gloss)) : sharpest};
}

PrincipledValues Principled::on_this_side(PrincipledValues v) const {
    if (!outside_) v.eta = 1.0 / v.eta;
    return v;
}

// The probabilities of the lobes; among facets, reflection and transmission each get at least a tenth.
Principled::Probabilities Principled::probabilities(const PrincipledValues& v, const Vec3& wo) const {
    const double F = 0.1 + 0.8 * conductor_fresnel(wo.z, v.eta, 0.0), glass = glass_share(v);
    if (!outside_) return glass > 0.0 ? Probabilities{0.0, 0.0, F, 1.0 - F} : Probabilities{};
    const double all = 1.0 + diffuse_share(v) + 0.25 * v.clearcoat;
    return {diffuse_share(v) / all, 0.25 * v.clearcoat / all, (1.0 - glass * (1.0 - F)) / all, glass * (1.0 - F) / all};
}

Rgb Principled::eval(const PrincipledValues& v, const Vec3& wo, const Vec3& wi) const {
    if (wo.z <= 0.0 || wi.z == 0.0) return Rgb(0.0);
    const Vec3 m = normal_between(wo, wi, v.eta);
    const double cos_o = glm::dot(wo, m), cos_i = glm::dot(wi, m);
    if (cos_o <= 0.0) return Rgb(0.0);
    const Ggx facets(v.alpha());
    const double F = conductor_fresnel(cos_o, v.eta, 0.0);
    const double D_G = facets.density(m) / (facets.projected_area(wo) * facets.projected_area(above(wi)));
    if (wi.z < 0.0) {
        if (cos_i >= 0.0) return Rgb(0.0);
        const double bend = cos_o + v.eta * cos_i;
        return glm::sqrt(v.base_color) * (glass_share(v) * (1.0 - F) * D_G * cos_o * -cos_i / (bend * bend));
    }
    if (!outside_) return Rgb(glass_share(v) * F * D_G / 4.0);
    const double no_metal = 1.0 - v.metallic;
    Rgb f = v.base_color * (diffuse_share(v) * v.diffuse(wo.z, wi.z, cos_o) * inv_pi) + v.sheen_color(cos_o) * no_metal;
    if (v.eta != 1.0) {  // otherwise there is no boundary; in Mitsuba this also disables metal
        const Rgb mixed = v.metallic * schlick(v.base_color, cos_o, v.eta) +
                          no_metal * (v.spec_tint * v.tinted_fresnel(cos_o) + Rgb((1.0 - v.spec_tint) * F));
        f += mixed * (D_G / 4.0);
    }
    if (v.clearcoat > 0.0) {
        const double G = wo.z * wi.z / (coat_masking.projected_area(wo) * coat_masking.projected_area(wi));
        f += schlick(Rgb(0.04), cos_o, v.eta) * (0.25 * v.clearcoat * Gtr1(coat_alpha(v.clearcoat_gloss)).density(m) * G);
    }
    return f;
}

double Principled::pdf(const PrincipledValues& v, const Vec3& wo, const Vec3& wi) const {
    if (wo.z <= 0.0 || wi.z == 0.0) return 0.0;
    const Probabilities probability = probabilities(v, wo);
    const Vec3 m = normal_between(wo, wi, v.eta);
    const double cos_o = glm::dot(wo, m), cos_i = glm::dot(wi, m);
    if (cos_o <= 0.0) return 0.0;
    const Ggx facets(v.alpha());
    const double visible = facets.density(m) / facets.projected_area(wo);  // pdf of m per solid angle, divided by ωo·m
    if (wi.z < 0.0) {
        if (cos_i >= 0.0) return 0.0;
        const double bend = cos_o + v.eta * cos_i;
        return probability.transmission * visible * cos_o * v.eta * v.eta * -cos_i / (bend * bend);
    }
    double sum = probability.reflection * visible / 4.0 + probability.diffuse * wi.z * inv_pi;
    if (probability.coat > 0.0) sum += probability.coat * Gtr1(coat_alpha(v.clearcoat_gloss)).density(m) * m.z / (4.0 * cos_o);
    return sum;
}

BsdfSample Principled::sample(const PrincipledValues& v, const Vec3& wo, Vec2 u) const {
    if (wo.z <= 0.0) return {};
    const Probabilities probability = probabilities(v, wo);
    const double facets = probability.reflection + probability.transmission;
    if (facets == 0.0) return {};
    Vec3 wi;
    if (choose_first(probability.diffuse, u.x)) {
        wi = cosine_hemisphere(u);
    } else if (choose_first(probability.coat / (probability.coat + facets), u.x)) {
        const Vec3 m = Gtr1(coat_alpha(v.clearcoat_gloss)).sample(u);
        wi = 2.0 * glm::dot(wo, m) * m - wo;
        if (wi.z <= 0.0) return {};
    } else {
        const bool reflected = choose_first(probability.reflection / facets, u.x);
        const Vec3 m = Ggx(v.alpha()).sample_visible(wo, u);
        const double cosine = glm::dot(wo, m), cos2 = 1.0 - (1.0 - cosine * cosine) / (v.eta * v.eta);
        if (!reflected && cos2 <= 0.0) return {};
        wi = reflected ? 2.0 * cosine * m - wo : glm::normalize((cosine / v.eta - std::sqrt(cos2)) * m - wo / v.eta);
        if ((wi.z > 0.0) != reflected) return {};
    }
    const double density = pdf(v, wo, wi);
    if (!(density > 0.0)) return {};
    return {wi, eval(v, wo, wi) * (std::abs(wi.z) / density), density};
}

}  // namespace neumann
