#include "core/reader/bsdfs.h"

#include "core/reader/retroreflectors.h"
#include "core/reader/textures.h"
#include "core/reader/transparent_bsdfs.h"

#include <fmt/format.h>

namespace neumann::reader {

namespace {

Diffuse read_diffuse(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    const SurfaceFunction reflectance = read_color_texture(p, "reflectance", 0.5, Illuminant::d65, context);
    p.finish();
    return Diffuse(reflectance);
}

// `material`, `eta` and `k`. A list of wavelengths has no meaning here: what its RGB would be depends on what is made of it.
ConductorFresnel read_fresnel(Properties& p, const Context& context) {
    const std::string material = p.text("material").value_or("none");
    if (material != "none")
        p.fail("material",
               fmt::format("material '{}' of {} is not supported; allowed: none, which is a perfect mirror, or eta and k "
                           "in its place, as rgb or float",
                           material, p.title()));
    const auto read = [&](const std::string& name, double missing) {
        const Element* e = p.find(name, {"rgb", "float", "integer"});
        return e ? parse_color(p, name, *e, Illuminant::equal_energy, context.warnings) : Rgb(missing);
    };
    const Rgb eta = read("eta", 0.0);
    return {eta, read("k", 1.0)};
}

Conductor read_conductor(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    const ConductorFresnel fresnel = read_fresnel(p, context);
    const SurfaceFunction reflectance = read_color_texture(p, "specular_reflectance", 1.0, Illuminant::d65, context);
    p.finish();
    return Conductor(fresnel, reflectance);
}

// Mitsuba takes what is below 0.0001 for 0.0001.
double read_alpha(Properties& p) {
    const auto alpha = p.number("alpha"), u = p.number("alpha_u"), v = p.number("alpha_v");
    const std::string given = u ? "alpha_u" : v ? "alpha_v" : "alpha";
    if (alpha && (u || v)) p.fail(given, fmt::format("both alpha and {} are given, expected one of them", given));
    if (u.has_value() != v.has_value())
        p.fail(given, fmt::format("{} is given without {}, expected both, or alpha", given, u ? "alpha_v" : "alpha_u"));
    if (u && *u != *v)
        p.fail("alpha_v",
               fmt::format("alpha_u is {} and alpha_v is {}, expected the same: anisotropic roughness is not supported", *u, *v));
    const double value = u ? *u : alpha.value_or(0.1);
    if (value < 1e-4) p.fail(given, fmt::format("{} is {}, expected at least 0.0001; bsdf 'conductor' is smooth", given, value));
    return value;
}

Bsdf read_rough_conductor(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    const ConductorFresnel fresnel = read_fresnel(p, context);
    const SurfaceFunction reflectance = read_color_texture(p, "specular_reflectance", 1.0, Illuminant::d65, context);
    const std::string distribution = p.choice("distribution", {"beckmann", "ggx"}, "beckmann");
    const double alpha = read_alpha(p);
    p.boolean("sample_visible");  // how Mitsuba draws directions; changes noise only
    p.finish();
    if (distribution == "ggx") return RoughConductor(Ggx(alpha), fresnel, reflectance);
    return RoughConductor(Beckmann(alpha), fresnel, reflectance);
}

}  // namespace

Materials::Sides Bsdfs::sides(const Element& e) {
    const auto known = sides_.find(&e);
    if (known != sides_.end()) return known->second;
    if (!open_.insert(&e).second)
        throw InputError(e.place, fmt::format("bsdf '{}' stands inside itself", e.attribute("type").value));
    const Materials::Sides sides = read(e);
    open_.erase(&e);
    return sides_[&e] = sides;
}

Materials::Sides Bsdfs::read(const Element& e) {
    const std::string& type = e.attribute("type").value;
    const auto both = [&](const BothSides& b) {
        const int front = store(b.front);
        return Materials::Sides{front, store(b.back)};
    };
    if (type == "blendbsdf") return read_blend(e);
    if (type == "conductor") return {store(read_conductor(e, context_)), Materials::absorbing};
    if (type == "dielectric") return both(read_dielectric(e, context_));
    if (type == "diffuse") return {store(read_diffuse(e, context_)), Materials::absorbing};
    if (type == "mask") return read_mask(e);
    if (type == "null") return both(read_null(e, context_));
    if (type == "retroreflector") return {store(read_retroreflector(e, context_)), Materials::absorbing};
    if (type == "roughconductor") return {store(read_rough_conductor(e, context_)), Materials::absorbing};
    if (type == "roughdielectric") return both(read_rough_dielectric(e, context_));
    if (type == "thindielectric") return both(read_thin_dielectric(e, context_));
    if (type == "twosided") return read_two_sided(e);
    fail_type(e, {"blendbsdf", "conductor", "dielectric", "diffuse", "mask", "null", "retroreflector", "roughconductor",
                  "roughdielectric", "thindielectric", "twosided"});
}

Materials::Sides Bsdfs::read_two_sided(const Element& e) {
    Properties p(e, context_.objects);
    const std::vector<const Element*> nested = p.nested("bsdf", 2);
    p.finish();
    if (nested.empty()) throw InputError(e.place, "bsdf 'twosided' has no <bsdf> inside, expected one or two");
    for (const Element* inner : nested) {
        const std::string& type = inner->attribute("type").value;
        if (type == "twosided") throw InputError(e.place, "bsdf 'twosided' stands inside another one");
        const int front = sides(*inner).front;
        if (front != Materials::absorbing && transmits(bsdfs_[static_cast<std::size_t>(front)]))
            throw InputError(inner->place,
                             fmt::format("bsdf '{}' in bsdf 'twosided' lets light through, expected one that only reflects", type));
    }
    return {sides(*nested.front()).front, sides(*nested.back()).front};
}

Materials::Sides Bsdfs::default_sides(bool emits) {
    if (emits) return {};
    if (default_ == Materials::absorbing) default_ = store(Diffuse(Rgb(0.5)));
    return {default_, Materials::absorbing};
}

int Bsdfs::store(Bsdf bsdf) {
    bsdfs_.push_back(std::move(bsdf));
    return static_cast<int>(bsdfs_.size()) - 1;
}

}  // namespace neumann::reader
