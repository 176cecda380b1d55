#include "core/reader/formats/tungsten/bsdf_maker.h"

#include "core/base/did_you_mean.h"
#include "core/image/colour/metals.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/meshes/mesh_text.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader::tungsten {

namespace {

const std::vector<std::string> bsdf_types = {"conductor",
                                             "dielectric",
                                             "diffuse_transmission",
                                             "forward",
                                             "lambert",
                                             "mirror",
                                             "mixed",
                                             "null",
                                             "oren_nayar",
                                             "phong",
                                             "plastic",
                                             "rough_coat",
                                             "rough_conductor",
                                             "rough_dielectric",
                                             "rough_plastic",
                                             "smooth_coat",
                                             "thinsheet",
                                             "transparency"};

bool is_metal(const std::string& name) {
    return std::any_of(metals().begin(), metals().end(), [&](const Metal& metal) { return metal.name == name; });
}

}  // namespace

Element BsdfMaker::make() {
    const std::string type = read_type(o_, "bsdf", bsdf_types, "taken as 'lambert' of albedo 0.5", importing_);
    if (type.empty()) {
        Element grey = bsdf("diffuse");
        add_rgb(grey, "reflectance", Rgb(0.5), o_.place());
        return sided(std::move(grey));
    }
    Element e = make_type(type);
    check_bump();
    refuse_media(o_, {"int_medium", "ext_medium"}, importing_);
    o_.ignore({"name", "albedo"});  // has no effect on some types
    o_.finish();
    return e;
}

Element BsdfMaker::make_type(const std::string& type) {
    if (type == "conductor" || type == "rough_conductor") return make_conductor(type != "conductor");
    if (type == "dielectric" || type == "rough_dielectric") return make_dielectric(type != "dielectric");
    if (type == "plastic" || type == "rough_plastic") return make_plastic(type != "plastic");
    if (type == "smooth_coat" || type == "rough_coat") return make_coat(type != "smooth_coat");
    if (type == "diffuse_transmission") return make_diffuse_transmission();
    if (type == "forward") return bsdf("null");
    if (type == "mirror") return make_mirror();
    if (type == "mixed") return make_mixed();
    if (type == "oren_nayar") return make_oren_nayar();
    if (type == "phong") return make_phong();
    if (type == "thinsheet") return make_thin_sheet();
    if (type == "transparency") return make_transparency();
    if (type == "lambert") return make_lambert();
    Element black = bsdf("diffuse");  // type 'null'
    add_rgb(black, "reflectance", Rgb(0.0), o_.place());
    return sided(std::move(black));
}

Element BsdfMaker::bsdf(const std::string& type) const { return make_object("bsdf", type, o_.place()); }

Element BsdfMaker::two_sided(Element inner) const {
    Element e = bsdf("twosided");
    add(e, std::move(inner));
    return e;
}

double BsdfMaker::index_of_refraction(double missing) {
    const double ior = o_.number("ior", missing);
    if (!(ior > 0.0)) o_.complain("ior", fmt::format("ior is {}, expected more than 0", ior));
    return ior > 0.0 ? ior : missing;
}

void BsdfMaker::add_indices(Element& e, double missing) {
    add_float(e, "int_ior", index_of_refraction(missing), o_.place_of("ior"));
    add_float(e, "ext_ior", 1.0, o_.place_of("ior"));
}

void BsdfMaker::add_roughness(Element& e, double missing) {
    constexpr double least = 1e-3;
    static const std::vector<std::string> names = {"beckmann", "ggx", "phong"};
    std::string distribution = o_.text("distribution").value_or("ggx");
    if (std::find(names.begin(), names.end(), distribution) == names.end()) {
        importing_.refuse(o_.place_of("distribution"), fmt::format("distribution '{}' is not supported", printable(distribution)),
                          "; " + allowed_instead(distribution, names), "taken as 'ggx'");
        distribution = "ggx";
    }
    if (distribution == "phong") {
        importing_.notes.warnings.add("the distribution 'phong' of microfacets: 'beckmann' of the same roughness is taken");
        distribution = "beckmann";
    }
    add_string(e, "distribution", distribution, o_.place_of("distribution"));
    TextureValue roughness = textures_.find_number(o_, "roughness").value_or(TextureValue{o_.place(), Rgb(missing)});
    if (!roughness.texture) roughness.constant = glm::max(roughness.constant, least);
    add_number(e, "alpha", roughness);
}

// Adds a metal by name, or by η and k.
void BsdfMaker::add_metal(Element& e) {
    const std::optional<Vec3> eta = find_vector(o_, "eta"), k = find_vector(o_, "k");
    const std::optional<std::string> name = o_.text("material");
    if (name || !(eta || k)) {
        std::string metal = name.value_or("Cu");
        // Some metals have a longer name in Mitsuba.
        if (!is_metal(metal) && is_metal(metal + "_palik")) metal += "_palik";
        if (!is_metal(metal)) {
            std::vector<std::string> names;
            for (const Metal& known : metals()) names.emplace_back(known.name);
            importing_.refuse(o_.place_of("material"), fmt::format("material '{}' is not known", printable(metal)),
                              did_you_mean(metal, names), "taken as 'Cu'");
            metal = "Cu";
        }
        add_string(e, "material", metal, o_.place_of("material"));
        return;
    }
    if (!eta || !k)
        o_.complain(eta ? "eta" : "k",
                    fmt::format("{0} is given without {1}, expected both", eta ? "eta" : "k", eta ? "k" : "eta"));
    add_rgb(e, "eta", eta.value_or(Vec3(1.0)), o_.place_of("eta"));
    add_rgb(e, "k", k.value_or(Vec3(1.0)), o_.place_of("k"));
}

void BsdfMaker::refuse_absorption() {
    const double thickness = o_.number("thickness", 1.0, not_negative);
    const std::optional<Vec3> sigma = find_vector(o_, "sigma_a");
    if (sigma && thickness > 0.0 && *sigma != Vec3(0.0))
        importing_.refuse(o_.place_of("sigma_a"), "sigma_a of this bsdf, a layer that absorbs, is not supported", ", expected 0",
                          "taken as 0");
}

// Refuses a bump map; constant heights bend nothing.
void BsdfMaker::check_bump() {
    const nlohmann::json* bump = o_.value("bump");
    const bool varies = bump && (bump->is_string() || (bump->is_object() && bump->value("type", nlohmann::json()) != "constant"));
    if (varies)
        importing_.refuse(o_.place_of("bump"), "bump is not supported", ": how deep it is depends on the picture's size",
                          "left out");
}

}  // namespace neumann::reader::tungsten
