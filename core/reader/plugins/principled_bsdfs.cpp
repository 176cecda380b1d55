#include "core/reader/plugins/principled_bsdfs.h"

#include "core/reader/plugins/textures.h"

#include <fmt/format.h>

namespace neumann::reader {

namespace {

SurfaceFunction read_number(Properties& p, const std::string& name, double missing, double largest, const Context& context) {
    const SurfaceFunction f = read_number_texture(p, name, missing, context);
    const double value = f.upper_bound().r;
    if (f.is_constant() && !(value >= 0.0 && value <= largest))
        p.complain(name, fmt::format("{} is {}, expected 0 to {}", name, value, largest));
    return f;
}

bool is_zero(const SurfaceFunction& f) { return f.is_constant() && f.upper_bound().r == 0.0; }

// The parameters that `principled` and `principledthin` share.
PrincipledParameters read_common(Properties& p, const Context& context) {
    const auto read = [&](const std::string& name, double missing) { return read_number(p, name, missing, 1.0, context); };
    PrincipledParameters v;
    v.base_color = read_color_texture(p, "base_color", 0.5, Illuminant::d65, context);
    v.roughness = read("roughness", 0.5);
    v.anisotropic = read("anisotropic", 0.0);
    v.spec_trans = read("spec_trans", 0.0);
    v.spec_tint = read("spec_tint", 0.0);
    v.sheen = read("sheen", 0.0);
    v.sheen_tint = read("sheen_tint", 0.0);
    v.flatness = read("flatness", 0.0);
    return v;
}

// Reads and ignores Mitsuba's sampling rates of the lobes, which change noise only.
void read_sampling_rates(Properties& p, std::initializer_list<const char*> names) {
    for (const char* name : names) p.number(name);
}

// Reads η, or Burley's `specular`: the reflectance at normal incidence is 0.08 times that. Glass needs η ≠ 1.
double read_eta(Properties& p, bool is_glass) {
    const auto eta = p.number("eta"), specular = p.number("specular");
    if (eta && specular) p.complain("specular", "both eta and specular are given, expected one of them");
    if (eta) {
        if (!(*eta > 0.0)) p.complain("eta", fmt::format("eta is {}, expected more than 0", *eta));
        return is_glass && *eta == 1.0 ? 1.001 : *eta;
    }
    double value = specular.value_or(0.5);
    if (!(value >= 0.0 && value <= 1.0)) p.complain("specular", fmt::format("specular is {}, expected 0 to 1", value));
    if (is_glass && value == 0.0) value = 1e-3;
    return 2.0 / (1.0 - std::sqrt(0.08 * value)) - 1.0;
}

}  // namespace

PrincipledSides read_principled(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    auto v = std::make_shared<PrincipledParameters>(read_common(p, context));
    v->metallic = read_number(p, "metallic", 0.0, 1.0, context);
    v->clearcoat = read_number(p, "clearcoat", 0.0, 1.0, context);
    v->clearcoat_gloss = read_number(p, "clearcoat_gloss", 0.0, 1.0, context);
    const bool is_glass = !is_zero(v->spec_trans);
    v->eta = Rgb(read_eta(p, is_glass));
    read_sampling_rates(p, {"main_specular_sampling_rate", "clearcoat_sampling_rate", "diffuse_reflectance_sampling_rate"});
    p.finish();
    PrincipledSides sides{Principled(v, Principled::Side::outside), std::nullopt};
    if (is_glass) sides.inside = Principled(v, Principled::Side::inside);
    return sides;
}

Bsdf read_principled_thin(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    auto v = std::make_shared<PrincipledParameters>(read_common(p, context));
    v->diff_trans = read_number(p, "diff_trans", 0.0, 2.0, context);
    v->eta = read_number_texture(p, "eta", 1.5, context);
    if (v->eta.is_constant() && !(v->eta.upper_bound().r > 0.0))
        p.complain("eta", fmt::format("eta is {}, expected more than 0", v->eta.upper_bound().r));
    read_sampling_rates(p, {"diffuse_reflectance_sampling_rate", "specular_reflectance_sampling_rate",
                            "specular_transmittance_sampling_rate", "diffuse_transmittance_sampling_rate"});
    p.finish();
    return PrincipledThin(v);
}

}  // namespace neumann::reader
