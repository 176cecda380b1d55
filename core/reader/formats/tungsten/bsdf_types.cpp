// Makes each type of material.
#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/tungsten/bsdf_maker.h"

#include <fmt/format.h>

namespace neumann::reader::tungsten {

Element BsdfMaker::make_lambert() {
    Element e = bsdf("diffuse");
    add_color(e, "reflectance", albedo());
    return sided(std::move(e));
}

Element BsdfMaker::make_oren_nayar() {
    const auto roughness = textures_.find_number(o_, "roughness");
    if (!roughness || !roughness->is_black())
        importing_.refuse(o_.place_of("type"), "bsdf type 'oren_nayar' is not supported", ", expected a roughness of 0",
                          "taken as 'lambert'");
    return make_lambert();
}

Element BsdfMaker::make_phong() {
    Element e = bsdf("phong");
    const double diffuse = o_.number("diffuse_ratio", 0.2, share);
    const TextureValue color = albedo();
    add_float(e, "exponent", o_.number("exponent", 64.0, not_negative), o_.place_of("exponent"));
    add_color(e, "diffuse_reflectance", times(color, diffuse));
    add_color(e, "specular_reflectance", times(color, 1.0 - diffuse));
    add_boolean(e, "ensure_energy_conservation", false, o_.place());
    return sided(std::move(e));
}

// Tungsten's mirror reflects from both sides in any case.
Element BsdfMaker::make_mirror() {
    Element e = bsdf("conductor");
    add_string(e, "material", "none", o_.place());
    add_color(e, "specular_reflectance", albedo());
    return two_sided(std::move(e));
}

Element BsdfMaker::make_conductor(bool is_rough) {
    Element e = bsdf(is_rough ? "roughconductor" : "conductor");
    add_metal(e);
    add_color(e, "specular_reflectance", albedo());
    if (is_rough) add_roughness(e, 0.1);
    return sided(std::move(e));
}

// Without refraction a dielectric is a plastic on black.
Element BsdfMaker::make_dielectric(bool is_rough) {
    const bool refracts = o_.boolean("enable_refraction", true);
    Element e = bsdf(refracts ? (is_rough ? "roughdielectric" : "dielectric") : (is_rough ? "roughplastic" : "plastic"));
    add_indices(e, 1.5);
    const TextureValue color = albedo();
    add_color(e, "specular_reflectance", color);
    if (refracts)
        add_color(e, "specular_transmittance", color);
    else
        add_rgb(e, "diffuse_reflectance", Rgb(0.0), o_.place());
    if (is_rough) add_roughness(e, 0.1);
    return refracts ? std::move(e) : sided(std::move(e));
}

Element BsdfMaker::make_plastic(bool is_rough) {
    Element e = bsdf(is_rough ? "roughplastic" : "plastic");
    add_indices(e, 1.5);
    add_color(e, "diffuse_reflectance", albedo());
    add_boolean(e, "nonlinear", true, o_.place());
    refuse_absorption();
    if (is_rough) {
        add_roughness(e, 0.02);
        importing_.notes.warnings.add("rough_plastic: light enters it through a rough surface, in Tungsten through a smooth one");
    }
    return sided(std::move(e));
}

Element BsdfMaker::make_thin_sheet() {
    Element e = bsdf("thindielectric");
    add_indices(e, 1.5);
    textures_.find_number(o_, "thickness");  // matters only for interference, which is refused
    if (o_.boolean("enable_interference", false))
        importing_.refuse(o_.place_of("enable_interference"), "enable_interference is not supported", ", expected false",
                          "taken as false");
    if (find_vector(o_, "sigma_a").value_or(Vec3(0.0)) != Vec3(0.0))
        importing_.refuse(o_.place_of("sigma_a"), "sigma_a of this bsdf, a layer that absorbs, is not supported", ", expected 0",
                          "taken as 0");
    importing_.notes.warnings.add("thinsheet: light between its sides is taken as unpolarised, as in Mitsuba");
    return e;
}

// Half of the light is reflected and half let through: a principledthin with diff_trans 2 only transmits, as by Lambert's law.
Element BsdfMaker::make_diffuse_transmission() {
    const TextureValue color = albedo();
    Element reflecting = bsdf("diffuse"), transmitting = bsdf("principledthin"), e = bsdf("blendbsdf");
    add_color(reflecting, "reflectance", color);
    add_color(transmitting, "base_color", color);
    add_float(transmitting, "diff_trans", 2.0, o_.place());
    add_float(e, "weight", 0.5, o_.place());
    add(e, two_sided(std::move(reflecting)));
    add(e, std::move(transmitting));
    return e;
}

Element BsdfMaker::make_mixed() {
    Element e = bsdf("blendbsdf");
    add_number(e, "weight", textures_.find_number(o_, "ratio").value_or(TextureValue{o_.place(), Rgb(0.5)}));
    // The weight is that of the second bsdf.
    for (const char* name : {"bsdf1", "bsdf0"})
        if (!all_.add_nested(e, o_, name, sided_)) o_.fail_missing(name, "the name of a bsdf or an object");
    if (const TextureValue color = albedo(); color.texture || color.constant != Rgb(1.0))
        importing_.refuse(o_.place_of("albedo"), "albedo of a mixed bsdf is not supported", ", expected 1; give those inside one",
                          "taken as 1");
    return e;
}

Element BsdfMaker::make_transparency() {
    Element e = bsdf("mask");
    add_number(e, "opacity", textures_.find_opacity(o_, "alpha").value_or(TextureValue{o_.place(), Rgb(1.0)}));
    if (all_.add_nested(e, o_, "base", sided_)) return e;
    Element white = bsdf("diffuse");
    add_rgb(white, "reflectance", Rgb(1.0), o_.place());
    add(e, sided(std::move(white)));
    return e;
}

Element BsdfMaker::make_coat(bool is_rough) {
    Element e = bsdf("coating");
    add_indices(e, 1.3);
    add_float(e, "thickness", o_.number("thickness", 1.0, not_negative), o_.place_of("thickness"));
    add_rgb(e, "sigma_a", find_vector(o_, "sigma_a").value_or(Vec3(0.0)), o_.place_of("sigma_a"));
    if (is_rough) {
        importing_.refuse(o_.place_of("type"), "bsdf type 'rough_coat' is not supported", "; allowed: smooth_coat",
                          "taken as 'smooth_coat'");
        o_.ignore({"distribution", "roughness"});
    }
    if (all_.add_nested(e, o_, "substrate", sided_)) return e;
    Element copper = bsdf("roughconductor");
    add_string(copper, "material", "Cu", o_.place());
    add_string(copper, "distribution", "ggx", o_.place());
    add_float(copper, "alpha", 0.1, o_.place());
    add(e, sided(std::move(copper)));
    return e;
}

}  // namespace neumann::reader::tungsten
