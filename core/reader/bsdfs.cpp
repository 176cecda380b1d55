#include "core/reader/bsdfs.h"

#include "core/reader/grammar.h"
#include "core/reader/plastics.h"
#include "core/reader/principled.h"
#include "core/reader/roughness.h"
#include "core/reader/textures.h"
#include "core/spectrum/metals.h"

#include <fmt/format.h>

namespace neumann::reader {

namespace {

Diffuse read_diffuse(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    const SurfaceFunction reflectance = read_color_texture(p, "reflectance", 0.5, Illuminant::d65, context);
    p.finish();
    return Diffuse(reflectance);
}

// `material`, or `eta` and `k`.
ConductorFresnel read_fresnel(Properties& p, const Context& context) {
    const std::string material = p.text("material").value_or("none");
    const Element* eta = p.find("eta", color_types);
    const Element* k = p.find("k", color_types);
    const auto read = [&](const std::string& name, const Element* e, double missing) {
        return e ? parse_metal_index(p, name, *e, context.warnings) : Rgb(missing);
    };
    if (material == "none") return {read("eta", eta, 0.0), read("k", k, 1.0)};
    if (eta || k) {
        const std::string given = eta ? "eta" : "k";
        p.fail(given, fmt::format("both material and {} are given, expected one of them", given));
    }
    std::vector<std::string> names = {"none"};
    for (const Metal& metal : metals()) {
        if (metal.name == material) return {metal.eta, metal.k};
        names.emplace_back(metal.name);
    }
    p.fail("material", fmt::format("material '{}' of {} is unknown; allowed: {}", material, p.title(), join(names)));
}

Conductor read_conductor(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    const ConductorFresnel fresnel = read_fresnel(p, context);
    const SurfaceFunction reflectance = read_color_texture(p, "specular_reflectance", 1.0, Illuminant::d65, context);
    p.finish();
    return Conductor(fresnel, reflectance);
}

Bsdf read_rough_conductor(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    const ConductorFresnel fresnel = read_fresnel(p, context);
    const SurfaceFunction reflectance = read_color_texture(p, "specular_reflectance", 1.0, Illuminant::d65, context);
    const RoughnessParameters roughness = read_roughness(p, context);
    p.finish();
    const auto made_of = [&]<class Microfacets>(Roughness<Microfacets> r) {
        return RoughConductor<Microfacets>(std::move(r), fresnel, reflectance);
    };
    if (roughness.ggx) return made_of(Roughness<Ggx>(roughness.alpha_u, roughness.alpha_v));
    return made_of(Roughness<Beckmann>(roughness.alpha_u, roughness.alpha_v));
}

}  // namespace

Materials::Sides Bsdfs::sides(const Element& e) {
    const auto known = sides_.find(&e);
    return known != sides_.end() ? known->second : sides_[&e] = read(e);
}

Materials::Sides Bsdfs::read(const Element& e) {
    const std::string& type = e.attribute("type").value;
    if (type == "diffuse") return {store(read_diffuse(e, context_)), Materials::absorbing};
    if (type == "conductor") return {store(read_conductor(e, context_)), Materials::absorbing};
    if (type == "roughconductor") return {store(read_rough_conductor(e, context_)), Materials::absorbing};
    if (type == "normalmap" || type == "bumpmap") return read_perturbed_normal(e);
    if (type == "plastic") return {store(read_plastic(e, context_)), Materials::absorbing};
    if (type == "roughplastic") return {store(read_rough_plastic(e, context_)), Materials::absorbing};
    if (type == "principled") {
        PrincipledSides found = read_principled(e, context_);
        const int outside = store(std::move(found.outside));
        return {outside, found.inside ? store(std::move(*found.inside)) : Materials::absorbing};
    }
    if (type == "principledthin") {
        const int both = store(read_principled_thin(e, context_));
        return {both, both};
    }
    if (type != "twosided")
        fail_type(e, {"bumpmap", "conductor", "diffuse", "normalmap", "plastic", "principled", "principledthin", "roughconductor",
                      "roughplastic", "twosided"});

    Properties p(e, context_.objects);
    const std::vector<const Element*> nested = p.nested("bsdf", 2);
    p.finish();
    if (nested.empty()) throw InputError(e.place, "bsdf 'twosided' has no <bsdf> inside, expected one or two");
    for (const Element* inner : nested)
        if (inner->attribute("type").value == "twosided") throw InputError(e.place, "bsdf 'twosided' stands inside another one");
    for (const Element* inner : nested)
        if (sides(*inner).back != Materials::absorbing)
            throw InputError(inner->place, "a material with a back side stands inside bsdf 'twosided', expected one without");
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
