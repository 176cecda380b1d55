#include "core/reader/plugins/transparent_bsdfs.h"

#include "core/reader/plugins/ior.h"
#include "core/reader/plugins/roughness_parameters.h"
#include "core/reader/plugins/textures.h"

#include <fmt/format.h>

namespace neumann::reader {

namespace {

struct Boundary {
    double interior, exterior;
    SurfaceFunction reflectance, transmittance;
};

Boundary read_boundary(Properties& p, const Context& context) {
    const double interior = read_ior(p, "int_ior", "bk7", context), exterior = read_ior(p, "ext_ior", "air", context);
    return {interior, exterior, read_color_texture(p, "specular_reflectance", 1.0, Illuminant::d65, context),
            read_color_texture(p, "specular_transmittance", 1.0, Illuminant::d65, context)};
}

template <class Microfacets>
BothSides rough_sides(const Boundary& b, const RoughnessParameters& r) {
    const Roughness<Microfacets> roughness(r.alpha_u, r.alpha_v);
    return {RoughDielectric<Microfacets>(roughness, b.interior / b.exterior, b.reflectance, b.transmittance),
            RoughDielectric<Microfacets>(roughness, b.exterior / b.interior, b.reflectance, b.transmittance)};
}

}  // namespace

BothSides read_dielectric(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    const Boundary b = read_boundary(p, context);
    p.finish();
    return {Dielectric(b.interior / b.exterior, b.reflectance, b.transmittance),
            Dielectric(b.exterior / b.interior, b.reflectance, b.transmittance)};
}

BothSides read_thin_dielectric(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    const Boundary b = read_boundary(p, context);
    p.finish();
    const ThinDielectric pane(b.interior / b.exterior, b.reflectance, b.transmittance);
    return {pane, pane};
}

BothSides read_rough_dielectric(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    const Boundary b = read_boundary(p, context);
    if (b.interior == b.exterior)
        p.complain("int_ior", fmt::format("int_ior and ext_ior of {} are both {}, expected different ones", p.title(), b.interior),
                   {"ext_ior"});
    const RoughnessParameters roughness = read_roughness(p, context);
    p.finish();
    return roughness.ggx ? rough_sides<Ggx>(b, roughness) : rough_sides<Beckmann>(b, roughness);
}

BothSides read_null(const Element& e, const Context& context) {
    Properties(e, context.objects).finish();
    return {Null(), Null()};
}

}  // namespace neumann::reader
