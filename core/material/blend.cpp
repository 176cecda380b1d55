#include "core/material/blend.h"

#include "core/material/bsdf.h"
#include "core/sampling/choose.h"

namespace neumann {

Rgb Blend::eval(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
    const Rgb weight = weight_(p);
    Rgb sum(0.0);
    if (first_) sum += (1.0 - weight) * neumann::eval(*first_, p, wo, wi);
    if (second_) sum += weight * neumann::eval(*second_, p, wo, wi);
    return sum;
}

double Blend::pdf(const ShadingPoint& p, const Vec3& wo, const Vec3& wi) const {
    const double weight = weight_(p).r;
    return (first_ ? (1.0 - weight) * neumann::pdf(*first_, p, wo, wi) : 0.0) +
           (second_ ? weight * neumann::pdf(*second_, p, wo, wi) : 0.0);
}

BsdfSample Blend::sample(const ShadingPoint& p, const Vec3& wo, Vec2 u) const {
    const double weight = weight_(p).r;
    const bool is_first = choose_first(1.0 - weight, u.x);
    const Bsdf *chosen = (is_first ? first_ : second_).get(), *other = (is_first ? second_ : first_).get();
    if (!chosen) return {};
    const BsdfSample sampled = neumann::sample(*chosen, p, wo, u);
    if (sampled.pdf == 0.0 || sampled.pdf == delta_pdf) return sampled;
    const double of_other = is_first ? weight : 1.0 - weight;
    const double from_chosen = (1.0 - of_other) * sampled.pdf;
    if (!other) return {sampled.wi, sampled.weight, from_chosen};
    const double density = from_chosen + of_other * neumann::pdf(*other, p, wo, sampled.wi);
    const Rgb by_other = neumann::eval(*other, p, wo, sampled.wi) * (of_other * std::abs(sampled.wi.z));
    return {sampled.wi, (sampled.weight * from_chosen + by_other) / density, density};
}

double Blend::pdf_from_light(const ShadingPoint& p, const Vec3& wi, const Vec3& wo) const {
    const double weight = weight_(p).r;
    return (first_ ? (1.0 - weight) * neumann::pdf_from_light(*first_, p, wi, wo) : 0.0) +
           (second_ ? weight * neumann::pdf_from_light(*second_, p, wi, wo) : 0.0);
}

BsdfSample Blend::sample_from_light(const ShadingPoint& p, const Vec3& wi, Vec2 u) const {
    const Bsdf* const chosen = (choose_first(1.0 - weight_(p).r, u.x) ? first_ : second_).get();
    if (!chosen) return {};
    BsdfSample sampled = neumann::sample_from_light(*chosen, p, wi, u);
    if (sampled.pdf != 0.0 && sampled.pdf != delta_pdf) sampled.pdf = pdf_from_light(p, wi, sampled.wi);
    return sampled;
}

Rgb Blend::reflectance(const ShadingPoint& p) const {
    if (lobe().kind != Lobe::Kind::diffuse) return Rgb(1.0);
    const Rgb weight = weight_(p);
    return (first_ ? (1.0 - weight) * neumann::reflectance(*first_, p) : Rgb(0.0)) +
           (second_ ? weight * neumann::reflectance(*second_, p) : Rgb(0.0));
}
Bsdf Blend::white() const {
    if (lobe().kind != Lobe::Kind::diffuse) return *this;
    return neumann::white(first_ ? *first_ : *second_);
}

// (1 − w) a + w b lies between its values at the ends of w.
template <class Bound>
Rgb Blend::bound(const Bound& of) const {
    const Rgb a = first_ ? of(*first_) : Rgb(0.0), b = second_ ? of(*second_) : Rgb(0.0), weight = weight_.upper_bound();
    const Rgb mixed = (1.0 - weight) * a + weight * b;
    return weight_.is_constant() ? mixed : glm::max(a, mixed);
}
Rgb Blend::largest_albedo() const {
    return bound([](const Bsdf& b) { return neumann::largest_albedo(b); });
}
Rgb Blend::largest_basic_albedo() const {
    return bound([](const Bsdf& b) { return neumann::largest_basic_albedo(b); });
}

double Blend::refractive_ratio() const {
    for (const auto& part : {first_, second_})
        if (part && neumann::refractive_ratio(*part) != 1.0) return neumann::refractive_ratio(*part);
    return 1.0;
}
bool Blend::transmits() const {
    return any([](const Bsdf& b) { return neumann::transmits(b); });
}
bool Blend::is_constant() const {
    return weight_.is_constant() && !any([](const Bsdf& b) { return !neumann::is_constant(b); });
}
bool Blend::needs_coordinates() const {
    return !weight_.is_constant() || any([](const Bsdf& b) { return neumann::needs_coordinates(b); });
}
bool Blend::is_grey() const {
    return !any([](const Bsdf& b) { return !neumann::is_grey(b); });
}

bool Blend::is_lawful() const {
    return !any([](const Bsdf& b) { return !neumann::is_lawful(b); });
}

Lobe Blend::lobe() const {
    const Lobe a = first_ ? neumann::lobe(*first_) : Lobe{}, b = second_ ? neumann::lobe(*second_) : Lobe{};
    return a.kind > b.kind || (a.kind == b.kind && a.alpha < b.alpha) ? a : b;
}

}  // namespace neumann
