#include "core/reader/plugins/plastics.h"

#include "core/reader/plugins/ior.h"
#include "core/reader/plugins/roughness_parameters.h"
#include "core/reader/plugins/textures.h"

#include <fmt/format.h>

namespace neumann::reader {

namespace {

struct Coating {
    double eta;
    SurfaceFunction diffuse, specular;
    bool nonlinear;
};

Coating read_coating(Properties& p, const Context& context) {
    const double inside = read_ior(p, "int_ior", "polypropylene", context), outside = read_ior(p, "ext_ior", "air", context);
    return {inside / outside, read_color_texture(p, "diffuse_reflectance", 0.5, Illuminant::d65, context),
            read_color_texture(p, "specular_reflectance", 1.0, Illuminant::d65, context), p.boolean("nonlinear").value_or(false)};
}

}  // namespace

Bsdf read_plastic(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    const Coating c = read_coating(p, context);
    p.finish();
    return Plastic(c.eta, c.diffuse, c.specular, c.nonlinear);
}

Bsdf read_rough_plastic(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    const Coating c = read_coating(p, context);
    const RoughnessParameters roughness = read_isotropic_roughness(p, context);
    p.finish();
    if (c.eta == 1.0) p.fail("int_ior", fmt::format("int_ior and ext_ior of {} are the same, expected different ones", p.title()));
    const SurfaceFunction& alpha = roughness.alpha_u;
    if (roughness.ggx) return RoughPlastic<Ggx>(Roughness<Ggx>(alpha, alpha), c.eta, c.diffuse, c.specular, c.nonlinear);
    return RoughPlastic<Beckmann>(Roughness<Beckmann>(alpha, alpha), c.eta, c.diffuse, c.specular, c.nonlinear);
}

}  // namespace neumann::reader
