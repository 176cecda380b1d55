#include "core/reader/plugins/glossy_bsdfs.h"

#include "core/reader/plugins/textures.h"

#include <fmt/format.h>

namespace neumann::reader {

namespace {

struct Reflectances {
    SurfaceFunction diffuse, specular;
};

// If both may add up to more than 1, Mitsuba scales them to 0.99.
Reflectances read_reflectances(Properties& p, const Context& context) {
    const SurfaceFunction diffuse = read_color_texture(p, "diffuse_reflectance", 0.5, Illuminant::d65, context);
    const SurfaceFunction specular = read_color_texture(p, "specular_reflectance", 0.2, Illuminant::d65, context);
    const double sum = max_component(diffuse.upper_bound() + specular.upper_bound());
    p.number("specular_sampling_weight");  // how often Mitsuba samples the lobe; changes noise only
    if (!p.boolean("ensure_energy_conservation").value_or(true) || sum <= 1.0) return {diffuse, specular};
    context.warnings.add(
        fmt::format("diffuse_reflectance and specular_reflectance of {} add up to {}: both scaled, to 0.99, as in "
                    "Mitsuba 0.6; ensure_energy_conservation = false keeps them",
                    p.title(), sum));
    return {scaled(diffuse, 0.99 / sum), scaled(specular, 0.99 / sum)};
}

SurfaceFunction read_at_least(Properties& p, const std::string& name, double missing, double least, const Context& context) {
    const SurfaceFunction f = read_number_texture(p, name, missing, context);
    const double value = f.upper_bound().r;
    if (f.is_constant() && !(value >= least)) p.complain(name, fmt::format("{} is {}, expected at least {}", name, value, least));
    return f;
}

}  // namespace

Bsdf read_phong(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    const SurfaceFunction exponent = read_at_least(p, "exponent", 30.0, 0.0, context);
    const Reflectances r = read_reflectances(p, context);
    p.finish();
    return Phong(PhongLobe(exponent), r.diffuse, r.specular);
}

Bsdf read_ward(const Element& e, const Context& context) {
    using Variant = WardLobe::Variant;
    Properties p(e, context.objects);
    const std::string variant = p.choice("variant", {"ward", "ward-duer", "balanced"}, "balanced");
    const SurfaceFunction u = read_at_least(p, "alpha_u", 0.1, 1e-4, context), v = read_at_least(p, "alpha_v", 0.1, 1e-4, context);
    const Reflectances r = read_reflectances(p, context);
    p.finish();
    const Variant read = variant == "ward" ? Variant::original : variant == "ward-duer" ? Variant::duer : Variant::balanced;
    return Ward(WardLobe(read, Roughness<Beckmann>(u, v)), r.diffuse, r.specular);
}

}  // namespace neumann::reader
