#include "core/material/principled_parameters.h"

#include <algorithm>

namespace neumann {

namespace {

constexpr Rgb luminance_weights(0.212671, 0.715160, 0.072169);  // as in Mitsuba

struct Number {
    SurfaceFunction PrincipledParameters::*function;
    double PrincipledValues::*value;
};
constexpr Number numbers[] = {{&PrincipledParameters::roughness, &PrincipledValues::roughness},
                              {&PrincipledParameters::anisotropic, &PrincipledValues::anisotropic},
                              {&PrincipledParameters::metallic, &PrincipledValues::metallic},
                              {&PrincipledParameters::spec_trans, &PrincipledValues::spec_trans},
                              {&PrincipledParameters::spec_tint, &PrincipledValues::spec_tint},
                              {&PrincipledParameters::sheen, &PrincipledValues::sheen},
                              {&PrincipledParameters::sheen_tint, &PrincipledValues::sheen_tint},
                              {&PrincipledParameters::flatness, &PrincipledValues::flatness},
                              {&PrincipledParameters::clearcoat, &PrincipledValues::clearcoat},
                              {&PrincipledParameters::clearcoat_gloss, &PrincipledValues::clearcoat_gloss},
                              {&PrincipledParameters::diff_trans, &PrincipledValues::diff_trans},
                              {&PrincipledParameters::eta, &PrincipledValues::eta}};

Rgb tint_of(const Rgb& base_color) {
    const double luminance = glm::dot(base_color, luminance_weights);
    return luminance > 0.0 ? base_color / luminance : Rgb(1.0);
}

double lerp(double a, double b, double t) { return a + t * (b - a); }

double schlick_weight(double cosine) {
    const double m = std::clamp(1.0 - cosine, 0.0, 1.0);
    return m * m * m * m * m;
}

}  // namespace

Vec2 PrincipledValues::alpha(double scale) const {
    const double r = scale * roughness, aspect = std::sqrt(1.0 - 0.9 * anisotropic);
    return glm::max(Vec2(r * r / aspect, r * r * aspect), Vec2(0.001));
}

double PrincipledValues::diffuse(double cos_o, double cos_i, double cos_d) const {
    const double o = schlick_weight(cos_o), i = schlick_weight(cos_i), retro = 2.0 * roughness * cos_d * cos_d;
    const double plain = (1.0 - 0.5 * i) * (1.0 - 0.5 * o) + retro * (o + i + o * i * (retro - 1.0));
    if (flatness == 0.0) return plain;
    const double grazing = 0.5 * retro, flattened = lerp(1.0, grazing, o) * lerp(1.0, grazing, i);
    return lerp(plain, 1.25 * (flattened * (1.0 / (cos_o + cos_i) - 0.5) + 0.5), flatness);
}

Rgb PrincipledValues::sheen_color(double cos_d) const {
    return (Rgb(1.0) + sheen_tint * (tint - Rgb(1.0))) * (sheen * schlick_weight(cos_d));
}

Rgb PrincipledValues::tinted_fresnel(double cosine) const {
    const double r = (eta - 1.0) / (eta + 1.0);
    return schlick(tint * (r * r), cosine, eta);
}

Rgb schlick(const Rgb& R0, double cosine, double eta) {
    const double inside = eta > 1.0 ? cosine : std::sqrt(std::max(1.0 - (1.0 - cosine * cosine) / (eta * eta), 0.0));
    return R0 + (Rgb(1.0) - R0) * schlick_weight(inside);
}

PrincipledValues PrincipledParameters::operator()(const ShadingPoint& p) const {
    PrincipledValues v;
    v.base_color = base_color(p);
    v.tint = tint_of(v.base_color);
    for (const Number& n : numbers) v.*n.value = (this->*n.function)(p).r;
    return v;
}

bool PrincipledParameters::is_constant() const {
    return base_color.is_constant() &&
           std::all_of(std::begin(numbers), std::end(numbers), [&](const Number& n) { return (this->*n.function).is_constant(); });
}

bool PrincipledParameters::is_grey() const {
    return base_color.is_grey() &&
           std::all_of(std::begin(numbers), std::end(numbers), [&](const Number& n) { return (this->*n.function).is_grey(); });
}

std::vector<PrincipledValues> PrincipledParameters::extremes() const {
    PrincipledValues first;
    first.base_color = base_color.upper_bound();
    first.tint = base_color.is_constant() ? tint_of(first.base_color) : 1.0 / luminance_weights;
    std::vector<PrincipledValues> all = {first};
    for (const Number& n : numbers) {
        const SurfaceFunction& f = this->*n.function;
        const double most = f.upper_bound().r;
        std::vector<double> values = {most};
        if (!f.is_constant()) values.push_back(n.value == &PrincipledValues::eta ? 1.0 : 0.0);
        if (!f.is_constant() && n.value == &PrincipledValues::roughness) values.push_back(0.5 * most);
        std::vector<PrincipledValues> next;
        for (PrincipledValues v : all)
            for (const double value : values) {
                v.*n.value = value;
                next.push_back(v);
            }
        all = std::move(next);
    }
    return all;
}

}  // namespace neumann
