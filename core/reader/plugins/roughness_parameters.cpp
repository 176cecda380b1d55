#include "core/reader/plugins/roughness_parameters.h"

#include "core/reader/plugins/textures.h"

#include <fmt/format.h>

namespace neumann::reader {

namespace {

void check_alpha(Properties& p, const std::string& name, const SurfaceFunction& alpha) {
    const double value = alpha.upper_bound().r;
    if (!(alpha.is_constant() && value < 1e-4)) return;
    const std::string rough = p.element().attribute("type").value;
    p.complain(name, fmt::format("{} is {}, expected at least 0.0001; bsdf '{}' is smooth", name, value,
                                 rough.substr(rough.starts_with("rough") ? 5 : 0)));
}

bool read_distribution(Properties& p) { return p.choice("distribution", {"beckmann", "ggx"}, "beckmann") == "ggx"; }

}  // namespace

RoughnessParameters read_roughness(Properties& p, const Context& context) {
    const bool ggx = read_distribution(p);
    const auto read = [&](const std::string& name) { return read_number_texture(p, name, NAN, context); };
    const auto given = [](const SurfaceFunction& f) { return !std::isnan(f.upper_bound().r); };
    const SurfaceFunction alpha = read("alpha"), u = read("alpha_u"), v = read("alpha_v");
    const std::string name = given(u) ? "alpha_u" : given(v) ? "alpha_v" : "alpha";
    if (given(alpha) && name != "alpha") p.complain(name, fmt::format("both alpha and {} are given, expected one of them", name));
    if (given(u) != given(v))
        p.complain(name, fmt::format("{} is given without {}, expected both, or alpha", name, given(u) ? "alpha_v" : "alpha_u"),
                   {"alpha_u", "alpha_v"});
    p.boolean("sample_visible");  // how Mitsuba draws directions; changes noise only
    if (given(u)) {
        check_alpha(p, "alpha_u", u);
        check_alpha(p, "alpha_v", v);
        return {ggx, u, v, false};
    }
    const SurfaceFunction both = given(alpha) ? alpha : Rgb(0.1);
    check_alpha(p, "alpha", both);
    return {ggx, both, both, true};
}

RoughnessParameters read_isotropic_roughness(Properties& p, const Context& context) {
    RoughnessParameters found = read_roughness(p, context);
    const double u = found.alpha_u.upper_bound().r, v = found.alpha_v.upper_bound().r;
    if (!found.is_isotropic && !(found.alpha_u.is_constant() && found.alpha_v.is_constant()))
        p.complain("alpha_u",
                   fmt::format("alpha_u and alpha_v of {} vary, expected alpha: it is alike in all directions", p.title()),
                   {"alpha_v"});
    else if (u != v)
        p.complain(
            "alpha_v",
            fmt::format("alpha_u is {} and alpha_v is {}, expected the same: {} is alike in all directions", u, v, p.title()),
            {"alpha", "alpha_u"});
    return found;
}

}  // namespace neumann::reader
