#include "core/reader/xml/upgrade.h"

#include "core/emitter/sun_radiance.h"
#include "core/reader/xml/numbers.h"
#include "core/reader/xml/spectra.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace neumann::reader {

namespace {

bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }

// Converts toWorld to to_world, intIOR to int_ior, and leaves B as it is.
std::string snake_case(const std::string& name) {
    std::string result;
    bool lowering = false;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const bool begins_word = i > 0 && is_lower(name[i - 1]) && is_upper(name[i]);
        lowering = is_upper(name[i]) && (lowering || begins_word);
        if (begins_word) result += '_';
        result += lowering ? static_cast<char>(name[i] - 'A' + 'a') : name[i];
    }
    return result;
}

// A parameter by its Mitsuba 3 name, or null.
const Element* find(const Element& e, const std::string& parameter) {
    const auto found = std::find_if(e.children.begin(), e.children.end(), [&](const Element& child) {
        const Attribute* name = child.broken ? nullptr : child.find("name");
        return name && name->value == parameter;
    });
    return found == e.children.end() ? nullptr : &*found;
}

Element make_operation(const std::string& tag, const Element* x, const Element* y, const Location& place) {
    Element e{tag, {}, {}, place};
    for (const auto& [axis, number] : {std::pair{"x", x}, std::pair{"y", y}})
        if (number) e.attributes.push_back({axis, number->attribute("value").value, number->attribute("value").place});
    return e;
}

// As in Mitsuba 3, to_uv translates first and then scales.
void gather_uv_transform(Element& parent, Warnings& warnings) {
    const auto number = [&](const std::string& name) {
        const Element* e = find(parent, name);
        return e && e->tag == "float" ? e : nullptr;
    };
    const std::array<const Element*, 4> given = {number("uoffset"), number("voffset"), number("uscale"), number("vscale")};
    const auto first = std::find_if(given.begin(), given.end(), [](const Element* e) { return e != nullptr; });
    if (first == given.end()) return;
    const Element& at = **first;
    Element transform{"transform", {{"name", "to_uv", at.attribute("name").place}}, {}, at.place};
    transform.children = {make_operation("translate", given[0], given[1], at.place),
                          make_operation("scale", given[2], given[3], at.place)};
    std::vector<Element> others;
    for (Element& e : parent.children)
        if (std::find(given.begin(), given.end(), &e) == given.end()) others.push_back(std::move(e));
    others.push_back(std::move(transform));
    parent.children = std::move(others);
    warnings.add("old scene file: uoffset, voffset, uscale and vscale taken as a transform to_uv");
}

// The type of an object; empty for a reference.
std::string type_or_nothing(const Element& e) {
    const Attribute* type = e.find("type");
    return type ? type->value : "";
}

void rename_type(Element& e, const std::string& type, Warnings& warnings) {
    for (Attribute& a : e.attributes)
        if (a.name == "type") {
            warnings.add(fmt::format("old scene file: {} '{}' taken as '{}'", e.tag, a.value, type));
            a.value = type;
        }
}

// Removes parameters, given by their Mitsuba 3 names; returns whether there were any.
bool drop(Element& e, const std::vector<std::string>& names) {
    return std::erase_if(e.children, [&](const Element& child) {
               const Attribute* name = child.find("name");
               return name && std::find(names.begin(), names.end(), name->value) != names.end();
           }) > 0;
}

// Pictures are linear here, and tone mapping is for viewers.
void upgrade_film(Element& e, Warnings& warnings) {
    if (type_or_nothing(e) == "ldrfilm") {
        rename_type(e, "hdrfilm", warnings);
        drop(e, {"file_format", "pixel_format", "tonemap_method", "gamma", "exposure", "key", "burn"});
    }
    drop(e, {"attach_log"});
}

void upgrade_sampler(Element& e, Warnings& warnings) {
    const std::string type = type_or_nothing(e);
    if (type == "sobol" || type == "halton" || type == "hammersley") rename_type(e, "ldsampler", warnings);
    if (type_or_nothing(e) == "ldsampler") drop(e, {"scramble", "dimension"});
}

// An exponent of 2.2 is treated as the sRGB curve, which it approximates; -1 means sRGB.
void upgrade_gamma(Element& e, Warnings& warnings) {
    const Element* given = find(e, "gamma");
    if (!given || (given->tag != "float" && given->tag != "integer")) return;
    const Attribute value = given->attribute("value");
    const double gamma = parse_number(value);
    if (gamma != 1.0 && gamma != 2.2 && gamma != -1.0)
        throw InputError(value.place, fmt::format("gamma of texture 'bitmap' is {}, expected 1, 2.2 or -1, which is sRGB", gamma));
    drop(e, {"gamma"});
    if (gamma == 1.0) {
        drop(e, {"raw"});
        e.children.push_back({"boolean", {{"name", "raw", value.place}, {"value", "true", value.place}}, {}, value.place});
    }
    warnings.add(fmt::format("old scene file: gamma {} of a bitmap taken as {}", gamma, gamma == 1.0 ? "raw" : "sRGB"));
}

// Renames the refractive index outside, or inside. Metals are in air, as in Mitsuba 3.
void upgrade_indices(Element& e, Warnings& warnings) {
    const std::string type = type_or_nothing(e);
    if (type == "conductor" || type == "roughconductor") {
        const Element* given = find(e, "ext_eta");
        if (!given) return;
        const Attribute value = given->attribute("value");
        const bool is_air =
            given->tag == "string" ? value.value == "air" || value.value == "vacuum" : std::abs(parse_number(value) - 1.0) < 1e-3;
        if (!is_air)
            throw InputError(value.place,
                             fmt::format("extEta of bsdf '{}' is '{}', expected 1 or air; eta and k divided by it say the "
                                         "same",
                                         type, value.value));
        drop(e, {"ext_eta"});
        warnings.add("old scene file: extEta of a metal left out, which is air");
        return;
    }
    if (type != "dielectric" && type != "thindielectric" && type != "roughdielectric" && type != "plastic" &&
        type != "roughplastic")
        return;
    for (Element& child : e.children)
        for (Attribute& a : child.attributes)
            if (a.name == "name" && (a.value == "ext_eta" || a.value == "int_eta")) {
                warnings.add(fmt::format("old scene file: {} of bsdf '{}' taken as {}", a.value == "ext_eta" ? "extEta" : "intEta",
                                         type, a.value == "ext_eta" ? "ext_ior" : "int_ior"));
                a.value = a.value == "ext_eta" ? "ext_ior" : "int_ior";
            }
}

void upgrade_bitmap(Element& e, Warnings& warnings) {
    upgrade_gamma(e, warnings);
    drop(e, {"cache", "max_anisotropy"});
    for (Element& child : e.children) {
        if (child.tag != "string" || child.broken || child.attribute("name").value != "filter_type") continue;
        for (Attribute& a : child.attributes)
            if (a.name == "value" && (a.value == "ewa" || a.value == "trilinear")) {
                warnings.add(fmt::format("old scene file: the texture filter '{}' taken as 'bilinear'", a.value));
                a.value = "bilinear";
            }
    }
}

// Mitsuba 3 finds the colours of vertices by a name.
void upgrade_vertex_colors(Element& e, Warnings& warnings) {
    rename_type(e, "mesh_attribute", warnings);
    e.children.push_back({"string", {{"name", "name", e.place}, {"value", "vertex_color", e.place}}, {}, e.place});
}

// The sky and the sun of 0.5 and 0.6 are those of `sunsky` above a darker ground. Their space has +y up, the north at −z and the
// east at +x, where that of `sunsky` has +z, −x and −y.
void upgrade_sky(Element& e, Warnings& warnings) {
    const std::string type = type_or_nothing(e);
    if (type != "sky" && type != "sun" && type != "sunsky") return;
    const auto add = [&](const std::string& name, const std::string& value, const Location& place) {
        if (!find(e, name)) e.children.push_back({"float", {{"name", name, place}, {"value", value, place}}, {}, place});
    };
    if (type != "sunsky") rename_type(e, "sunsky", warnings);
    drop(e, {"resolution"});
    if (const Element* scale = find(e, "scale"); scale && scale->find("value")) {
        const Attribute value = scale->attribute("value");
        drop(e, {"scale"});
        if (type != "sun") add("sky_scale", value.value, value.place);
        if (type != "sky") add("sun_scale", value.value, value.place);
    }
    if (type == "sky") add("sun_scale", "0", e.place);
    if (type == "sun") add("sky_scale", "0", e.place);
    add("albedo", "0.2", e.place);
    if (const Element* radius = find(e, "sun_radius_scale"); radius && radius->find("value")) {
        const Attribute value = radius->attribute("value");
        const double factor = parse_number(value);
        if (!(factor > 0.0))
            throw InputError(value.place, fmt::format("sunRadiusScale of emitter '{}' is {}, expected more than 0", type, factor));
        drop(e, {"sun_radius_scale"});
        add("sun_aperture", fmt::format("{}", sun_angle * factor), value.place);
    }
    Element axes{"matrix", {{"value", "0 -1 0 0  0 0 1 0  1 0 0 0  0 0 0 1", e.place}}, {}, e.place};
    if (!find(e, "to_world")) e.children.push_back({"transform", {{"name", "to_world", e.place}}, {}, e.place});
    for (Element& child : e.children)
        if (const Attribute* name = child.find("name"); name && name->value == "to_world" && child.tag == "transform")
            child.children.insert(child.children.begin(), axes);
    warnings.add("old scene file: emitter 'sunsky' turned, for its +y was up");
}

// A maxSmoothAngle of 0 means that no edge is smooth.
void upgrade_shape(Element& e, Warnings& warnings) {
    drop(e, {"collapse"});  // makes one mesh of a file's several, as here
    const Element* given = find(e, "max_smooth_angle");
    if (!given || !given->find("value")) return;
    const Attribute value = given->attribute("value");
    drop(e, {"max_smooth_angle"});
    if (parse_number(value) == 0.0 && !find(e, "face_normals"))
        e.children.push_back({"boolean", {{"name", "face_normals", value.place}, {"value", "true", value.place}}, {}, value.place});
    else
        warnings.add(
            "old scene file: maxSmoothAngle of a shape left out: all of its edges are smooth, or as its normals have them");
}

// Mitsuba 0.6 has spectra of three values. It integrates a list of wavelengths under equal energy, for light and
// surfaces alike, and a single value stands for all three.
void upgrade_spectra(Element& parent, Warnings& warnings) {
    for (Element& e : parent.children) {
        if (e.tag != "spectrum" || e.broken || e.find("type")) continue;
        const std::string& name = e.attribute("name").value;
        Attribute& value =
            *std::find_if(e.attributes.begin(), e.attributes.end(), [](const Attribute& a) { return a.name == "value"; });
        if (value.value.find(':') != std::string::npos) {
            const SpectrumTable table = parse_spectrum(value);
            for (std::size_t i = 0; i < table.values.size(); ++i)
                if (table.values[i] < 0.0)
                    throw InputError(value.place,
                                     fmt::format("{} is negative at {} nm: {}", name, table.wavelengths[i], table.values[i]));
            const bool is_share = name.ends_with("reflectance") || name.ends_with("transmittance");
            const Rgb c = spectrum_within_srgb(table, Illuminant::equal_energy, is_share ? 1.0 : INFINITY, warnings);
            value.value = fmt::format("{}, {}, {}", c.r, c.g, c.b);
            warnings.add("old scene file: a spectrum taken as its colour under equal energy, as Mitsuba 0.6 does");
        }
        std::erase_if(e.attributes, [](const Attribute& a) { return a.name != "name" && a.name != "value"; });
        e.tag = "rgb";
    }
}

// `strictNormals` is dropped: Mitsuba 3 has no test for shading normals that disagree with the surface.
void upgrade_integrator(Element& e, Warnings& warnings) {
    if (drop(e, {"strict_normals"})) warnings.add("old scene file: strictNormals of an integrator left out");
}

}  // namespace

void upgrade_tag(Element& e, Warnings& warnings) {
    if (e.tag != "lookAt") return;
    e.tag = "lookat";
    warnings.add("old scene file: <lookAt> taken as <lookat>");
}

void upgrade_from_2(Element& e) {
    if (e.tag != "film") return;
    for (Element& child : e.children)
        for (Attribute& a : child.attributes)
            if (a.name == "name" && a.value == "high_quality_edges") a.value = "sample_border";
}

void upgrade_parameters(Element& e, Warnings& warnings) {
    for (Attribute& a : e.attributes) {
        if (a.name != "name" || e.tag == "default" || snake_case(a.value) == a.value) continue;
        a.value = snake_case(a.value);
        warnings.add("old scene file: a name in camelCase taken in snake_case");
    }
    if (e.broken) return;
    if (e.tag == "bsdf") upgrade_indices(e, warnings);
    if (e.tag == "bsdf" && type_or_nothing(e) == "diffuse")
        for (Element& child : e.children)
            for (Attribute& a : child.attributes)
                if (a.name == "name" && a.value == "diffuse_reflectance") {
                    a.value = "reflectance";
                    warnings.add("old scene file: diffuseReflectance of bsdf 'diffuse' taken as reflectance");
                }
    gather_uv_transform(e, warnings);
    if (e.tag == "film") upgrade_film(e, warnings);
    if (e.tag == "sampler") upgrade_sampler(e, warnings);
    if (e.tag == "integrator") upgrade_integrator(e, warnings);
    if (e.tag == "emitter") upgrade_sky(e, warnings);
    if (e.tag == "texture" && type_or_nothing(e) == "bitmap") upgrade_bitmap(e, warnings);
    if (e.tag == "texture" && type_or_nothing(e) == "vertexcolors") upgrade_vertex_colors(e, warnings);
    if (e.tag == "shape") upgrade_shape(e, warnings);
    upgrade_spectra(e, warnings);
}

}  // namespace neumann::reader
