#include "core/reader/plugins/bsdfs.h"

#include "core/base/did_you_mean.h"
#include "core/image/colour/metals.h"
#include "core/reader/plugins/glossy_bsdfs.h"
#include "core/reader/plugins/plastics.h"
#include "core/reader/plugins/principled_bsdfs.h"
#include "core/reader/plugins/retroreflectors.h"
#include "core/reader/plugins/roughness_parameters.h"
#include "core/reader/plugins/textures.h"
#include "core/reader/plugins/transparent_bsdfs.h"
#include "core/reader/xml/grammar.h"

#include <fmt/format.h>

namespace neumann::reader {

namespace {

Diffuse read_diffuse(const Element& e, const Context& context) {
    Properties p(e, context.objects);
    const SurfaceFunction reflectance = read_color_texture(p, "reflectance", 0.5, Illuminant::d65, context);
    p.finish();
    return Diffuse(reflectance);
}

// Reads `material`, or `eta` and `k`.
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
        p.complain(given, fmt::format("both material and {} are given, expected one of them", given));
    }
    std::vector<std::string> names = {"none"};
    for (const Metal& metal : metals()) {
        if (metal.name == material) return {metal.eta, metal.k};
        names.emplace_back(metal.name);
    }
    p.refuse_word("material", fmt::format("material '{}' of {} is unknown", material, p.title()),
                  fmt::format("; {}", allowed_instead(material, names)));
    return {Rgb(0.0), Rgb(1.0)};
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
    if (known != sides_.end()) return known->second;
    if (open_.size() >= max_nesting) throw InputError(e.place, fmt::format("bsdfs are nested more than {} deep", max_nesting));
    if (!open_.insert(&e).second)
        throw InputError(e.place, fmt::format("bsdf '{}' stands inside itself", e.attribute("type").value));
    const auto sides = context_.problems().attempt(e.place, [&] { return read(e); });
    open_.erase(&e);
    return sides_[&e] = sides ? *sides : default_sides(false);
}

Materials::Sides Bsdfs::read(const Element& e) {
    const std::string& type = e.attribute("type").value;
    const auto both = [&](const BothSides& b) {
        const int front = store(b.front);
        return Materials::Sides{front, store(b.back)};
    };
    if (type == "blendbsdf") return read_blend(e);
    if (type == "coating") return read_coating(e);
    if (type == "conductor") return {store(read_conductor(e, context_)), Materials::absorbing};
    if (type == "dielectric") return both(read_dielectric(e, context_));
    if (type == "diffuse") return {store(read_diffuse(e, context_)), Materials::absorbing};
    if (type == "mask") return read_mask(e);
    if (type == "mixturebsdf") return read_mixture(e);
    if (type == "null") return both(read_null(e, context_));
    if (type == "phong") return {store(read_phong(e, context_)), Materials::absorbing};
    if (type == "retroreflector") return {store(read_retroreflector(e, context_)), Materials::absorbing};
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
        const int sides = store(read_principled_thin(e, context_));
        return {sides, sides};
    }
    if (type == "roughdielectric") return both(read_rough_dielectric(e, context_));
    if (type == "thindielectric") return both(read_thin_dielectric(e, context_));
    if (type == "twosided") return read_two_sided(e);
    if (type == "ward") return {store(read_ward(e, context_)), Materials::absorbing};
    fail_type(e, {"blendbsdf",      "bumpmap",         "coating",
                  "conductor",      "dielectric",      "diffuse",
                  "mask",           "mixturebsdf",     "normalmap",
                  "null",           "phong",           "plastic",
                  "principled",     "principledthin",  "retroreflector",
                  "roughconductor", "roughdielectric", "roughplastic",
                  "thindielectric", "twosided",        "ward"},
              "taken as 'diffuse' of reflectance 0.5");
}

Materials::Sides Bsdfs::read_two_sided(const Element& e) {
    Properties p(e, context_.objects);
    const std::vector<const Element*> nested = p.nested("bsdf", 2);
    p.finish();
    if (nested.empty()) p.fail_empty("bsdf 'twosided' has no <bsdf> inside, expected one or two");
    for (const Element* inner : nested) {
        const std::string& type = inner->attribute("type").value;
        if (type == "twosided") throw InputError(e.place, "bsdf 'twosided' stands inside another one");
        refuse_transmission(*inner, sides(*inner).front, "twosided");
    }
    return {sides(*nested.front()).front, sides(*nested.back()).front};
}

void Bsdfs::refuse_transmission(const Element& nested, int index, const std::string& outer) const {
    if (index == Materials::absorbing || !transmits(bsdfs_[static_cast<std::size_t>(index)])) return;
    throw InputError(nested.place, fmt::format("bsdf '{}' in bsdf '{}' lets light through, expected one that only reflects",
                                               nested.attribute("type").value, outer));
}

Materials::Sides Bsdfs::default_sides(bool emits) {
    if (emits) return {};
    if (default_ == Materials::absorbing) default_ = store(Diffuse(Rgb(0.5)));
    return {default_, Materials::absorbing};
}

double Bsdfs::parts_of(int index) const { return index == Materials::absorbing ? 0.0 : parts_[static_cast<std::size_t>(index)]; }

int Bsdfs::store(Bsdf bsdf, double parts) {
    bsdfs_.push_back(std::move(bsdf));
    parts_.push_back(parts);
    return static_cast<int>(bsdfs_.size()) - 1;
}

}  // namespace neumann::reader
