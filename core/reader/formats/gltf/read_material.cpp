#include "core/reader/formats/gltf/material.h"

#include <cmath>

#include <fmt/format.h>

namespace neumann::reader::gltf {

namespace {

void warn(const JsonObject& object, const std::string& what) { object.notes().warnings.add(what); }

void read_metallic_roughness(JsonObject o, const Textures& textures, Material& m) {
    const std::vector<double> base = o.numbers("baseColorFactor", {1.0, 1.0, 1.0, 1.0}, share);
    m.base = {base[0], base[1], base[2]};
    m.alpha = base[3];
    m.base_texture = textures.read(o, "baseColorTexture");
    m.metallic.factor = o.number("metallicFactor", 1.0, share);
    m.roughness.factor = o.number("roughnessFactor", 1.0, share);
    m.metallic.texture = m.roughness.texture = textures.read(o, "metallicRoughnessTexture");
    o.finish();
}

void read_specular(JsonObject o, Material& m) {
    m.specular = o.number("specularFactor", 1.0, share);
    const Rgb color = o.color("specularColorFactor", 1.0, not_negative);
    if (!is_grey(color)) warn(o, "KHR_materials_specular: a coloured reflection, taken as grey of the mean of its channels");
    const bool is_full = m.specular == 1.0;
    m.specular *= mean_component(color);
    if (m.specular != 1.0 && m.specular != 0.0 && !is_full)
        warn(o,
             "KHR_materials_specular: a specularFactor between 0 and 1, taken as a lower index of refraction: at grazing angles "
             "all light is still reflected");
    for (const char* name : {"specularTexture", "specularColorTexture"}) {
        if (o.has(name)) warn(o, fmt::format("KHR_materials_specular: {} left out", name));
        o.ignore({name});
    }
    o.finish();
}

void read_transmission(JsonObject o, const Textures& textures, Material& m) {
    m.transmission.factor = o.number("transmissionFactor", 0.0, share);
    m.transmission.texture = textures.read(o, "transmissionTexture");
    o.finish();
}

void read_volume(JsonObject o, Material& m) {
    m.is_solid = o.number("thicknessFactor", 0.0, not_negative) > 0.0;
    const Rgb color = o.color("attenuationColor", 1.0, share);
    if (const auto distance = o.find_number("attenuationDistance", not_negative);
        distance && m.is_solid && color != Rgb(1.0) && !m.transmission.is_zero())
        warn(o, "KHR_materials_volume: what a body absorbs (attenuationColor) left out");
    o.ignore({"thicknessTexture"});  // for programs that cannot tell the thickness from the mesh
    o.finish();
}

void leave_out_textures(JsonObject& o, const Textures& textures, const std::string& extension,
                        std::initializer_list<const char*> names) {
    for (const char* name : names)
        if (textures.read(o, name)) warn(o, fmt::format("{}: {} left out", extension, name));
}

void read_clearcoat(JsonObject o, const Textures& textures, Material& m) {
    m.clearcoat = o.number("clearcoatFactor", 0.0, share);
    m.clearcoat_gloss = 1.0 - o.number("clearcoatRoughnessFactor", 0.0, share);
    if (m.clearcoat > 0.0) {
        warn(o,
             "KHR_materials_clearcoat: taken as the clearcoat of Mitsuba's principled, a quarter as strong and of another shape");
        leave_out_textures(o, textures, "KHR_materials_clearcoat",
                           {"clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"});
    }
    o.ignore({"clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"});
    o.finish();
}

void read_sheen(JsonObject o, const Textures& textures, Material& m) {
    m.sheen = max_component(o.color("sheenColorFactor", 0.0, share));
    if (m.sheen > 0.0) {
        warn(o, "KHR_materials_sheen: taken as the sheen of Mitsuba's principled, white and of another shape");
        leave_out_textures(o, textures, "KHR_materials_sheen", {"sheenColorTexture", "sheenRoughnessTexture"});
    }
    o.ignore({"sheenRoughnessFactor", "sheenColorTexture", "sheenRoughnessTexture"});
    o.finish();
}

// Leaves out an extension, with a warning unless the factor that says how strong it is, is 0.
void leave_out(JsonObject& material, const std::string& extension, const std::string& factor, const std::string& what) {
    auto o = material.extension(extension);
    if (!o || o->number(factor, 0.0) == 0.0) return;
    warn(*o, fmt::format("{}: {} left out", extension, what));
}

void read_alpha(JsonObject& o, Material& m) {
    const std::string mode = o.text("alphaMode").value_or("OPAQUE");
    if (mode == "MASK")
        m.alpha_mode = Material::Alpha::cut_out;
    else if (mode == "BLEND")
        m.alpha_mode = Material::Alpha::blended;
    else if (mode != "OPAQUE")
        o.complain("alphaMode", fmt::format("alphaMode is '{}', expected OPAQUE, MASK or BLEND", mode));
    m.cutoff = o.number("alphaCutoff", 0.5, not_negative);
}

void read_emission(JsonObject& o, const Textures& textures, Material& m) {
    m.emission = o.color("emissiveFactor", 0.0, share);
    m.emission_texture = textures.read(o, "emissiveTexture");
    if (auto strength = o.extension("KHR_materials_emissive_strength")) {
        m.emission *= strength->number("emissiveStrength", 1.0, not_negative);
        strength->finish();
    }
}

// Makes the material diffuse, of reflectance 0.5.
void make_grey(Material& m) {
    m.base = Rgb(0.5);
    m.base_texture = std::nullopt;
    m.metallic = m.transmission = {};
    m.specular = m.clearcoat = m.sheen = 0.0;
}

void read_extensions(JsonObject& o, const Textures& textures, Material& m) {
    if (auto ior = o.extension("KHR_materials_ior")) {
        m.eta = ior->number("ior", 1.5, {1.0, 100.0});
        ior->finish();
    }
    if (auto e = o.extension("KHR_materials_specular")) read_specular(*e, m);
    if (auto e = o.extension("KHR_materials_transmission")) read_transmission(*e, textures, m);
    if (auto e = o.extension("KHR_materials_volume")) read_volume(*e, m);
    if (auto e = o.extension("KHR_materials_clearcoat")) read_clearcoat(*e, textures, m);
    if (auto e = o.extension("KHR_materials_sheen")) read_sheen(*e, textures, m);
    leave_out(o, "KHR_materials_iridescence", "iridescenceFactor", "the thin film");
    leave_out(o, "KHR_materials_anisotropy", "anisotropyStrength", "reflections that differ by direction");
    leave_out(o, "KHR_materials_dispersion", "dispersion", "dispersion");
    if (o.extension("KHR_materials_unlit")) warn(o, "KHR_materials_unlit: a material that no light reaches, lit like any other");
    for (const char* name : {"KHR_materials_pbrSpecularGlossiness", "KHR_materials_diffuse_transmission"})
        if (const auto e = o.extension(name)) {
            o.notes().problems.replace(
                Unknown(e->place(), fmt::format("{} is not supported", name), "; export the material as metallic-roughness",
                        "the material is taken as diffuse, of reflectance 0.5"),
                e->place());
            make_grey(m);
        }
}

}  // namespace

std::vector<const Texture*> Material::textures() const {
    std::vector<const Texture*> all;
    for (const std::optional<Texture>* t : {&base_texture, &metallic.texture, &normals, &emission_texture, &transmission.texture})
        if (*t) all.push_back(&**t);
    return all;
}

Material read_material(JsonObject o, const Textures& textures) {
    Material m;
    m.place = o.place();
    m.name = o.text("name").value_or("");
    if (m.name.empty()) m.name = "material_" + m.place.pointer.substr(m.place.pointer.rfind('/') + 1);
    auto basis = o.object("pbrMetallicRoughness");
    if (basis) read_metallic_roughness(*basis, textures, m);
    if (basis && basis->names().empty())
        warn(o,
             "a material of which the file says nothing: white, rough metal, as glTF has it; Blender writes this where the node is "
             "not "
             "Principled BSDF or Emission");
    m.normals = textures.read(o, "normalTexture");
    read_alpha(o, m);
    m.is_double_sided = o.boolean("doubleSided", false);
    read_emission(o, textures, m);
    read_extensions(o, textures, m);
    o.ignore({"occlusionTexture"});  // the operators find out themselves where no light comes
    o.finish();

    if (m.metallic.is_zero() && m.roughness.is_zero()) m.metallic.texture = m.roughness.texture = std::nullopt;
    if (m.transmission.is_zero()) m.transmission.texture = std::nullopt;
    if (!m.emits()) m.emission_texture = std::nullopt;
    if (m.normals && m.normals->amount == 0.0) m.normals = std::nullopt;
    return m;
}

}  // namespace neumann::reader::gltf
