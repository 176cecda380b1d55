// The properties that all materials have: roughness, normals, two sides.
#include "core/reader/formats/pbrt/bsdf_maker.h"

#include "core/base/did_you_mean.h"
#include "core/reader/formats/pbrt/colours.h"
#include "core/reader/meshes/mesh_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace neumann::reader::pbrt {

namespace {

constexpr std::array<std::string_view, 10> types_of_v3 = {"disney", "fourier", "glass",   "kdsubsurface", "matte",
                                                          "metal",  "mirror",  "plastic", "substrate",    "uber"};

Element object_in(const Element& inner, const std::string& type) {
    Element e = make_object("bsdf", type, inner.place);
    return e;
}

}  // namespace

const std::vector<std::string>& BsdfMaker::types() {
    static const std::vector<std::string> all = {"coatedconductor",     "coateddiffuse", "conductor", "dielectric",    "diffuse",
                                                 "diffusetransmission", "interface",     "mix",       "thindielectric"};
    return all;
}

Element BsdfMaker::make() {
    Element inner = make_type();
    Element e = with_normals(std::move(inner));
    p_.finish();
    if (p_.is_wrong()) throw AlreadyReported();
    return e;
}

Element BsdfMaker::make_type() {
    if (type_ == "diffuse") return make_diffuse();
    if (type_ == "conductor") return make_conductor();
    if (type_ == "dielectric") return make_dielectric();
    if (type_ == "thindielectric") return make_thin_dielectric();
    if (type_ == "diffusetransmission") return make_diffuse_transmission();
    if (type_ == "coateddiffuse") return make_coated_diffuse();
    if (type_ == "coatedconductor") return make_coated_conductor();
    const bool is_old = std::find(types_of_v3.begin(), types_of_v3.end(), type_) != types_of_v3.end();
    throw Unknown(p_.place(), fmt::format("material type '{}' is not supported", printable(type_)),
                  fmt::format("{}; {}", is_old ? ": it is of pbrt-v3, which 'pbrt --upgrade' of pbrt-v4 converts" : "",
                              allowed_instead(type_, types())),
                  "taken as 'diffuse' of reflectance 0.5");
}

TextureValue BsdfMaker::reflectance(const std::string& name, double missing) {
    return at_most_one(textures_.find_reflectance(p_, name).value_or(TextureValue{Rgb(missing)}), importer_);
}

double BsdfMaker::index(const std::string& name, double missing) { return find_index(p_, name, importer_).value_or(missing); }

BsdfMaker::Alphas BsdfMaker::read_alphas(const std::string& prefix) {
    const auto both = textures_.find_number(p_, prefix + "roughness");
    const auto u = textures_.find_number(p_, prefix + "uroughness"), v = textures_.find_number(p_, prefix + "vroughness");
    const bool remap = p_.boolean("remaproughness").value_or(true);
    // As in pbrt-v4's RoughnessToAlpha, α is the root of the roughness.
    const auto alpha = [&](const TextureValue& roughness) {
        return remap ? apply(
                           roughness, [](const Rgb& r) { return glm::sqrt(r); }, importer_, true)
                     : roughness;
    };
    const TextureValue missing = both.value_or(TextureValue{Rgb(0.0)});
    for (const std::string name : {"roughness", "uroughness", "vroughness"}) {
        const auto& value = name == "roughness" ? both : name == "uroughness" ? u : v;
        if (const Rgb* r = value ? value->constant() : nullptr; r && !(r->r >= 0.0))
            p_.complain(prefix + name, fmt::format("{}{} of {} is negative: {}", prefix, name, p_.title(), r->r));
    }
    if (p_.is_wrong()) return {};
    Alphas a;
    a.u = alpha(u.value_or(missing));
    a.is_isotropic = !u && !v;
    a.v = a.is_isotropic ? a.u : alpha(v.value_or(missing));
    constexpr double smooth = 1e-3, least = 1e-4;  // as in pbrt
    const Rgb *cu = a.u.constant(), *cv = a.v.constant();
    a.is_smooth = cu && cv && std::max(cu->r, cv->r) < smooth;
    a.is_isotropic = a.is_isotropic || (cu && cv && cu->r == cv->r);
    a.u = at_least(a.u, least, importer_);
    a.v = a.is_isotropic ? a.u : at_least(a.v, least, importer_);
    return a;
}

void BsdfMaker::add_alphas(Element& e, const Alphas& alphas) {
    add_string(e, "distribution", "ggx", p_.place());
    if (alphas.is_isotropic) {
        add(e, "alpha", alphas.u, true);
    } else {
        needs_coordinates_ = true;
        // On a disc pbrt's u goes around, and ours goes outwards.
        const bool swapped = coordinates_ == Coordinates::disk;
        add(e, swapped ? "alpha_v" : "alpha_u", alphas.u, true);
        add(e, swapped ? "alpha_u" : "alpha_v", alphas.v, true);
    }
    importer_.warnings.add("rough material: its masking is separable (G1 · G1), where pbrt's is height-correlated");
}

void BsdfMaker::add(Element& e, const std::string& name, const TextureValue& t, bool is_number) {
    if (!t.constant()) needs_coordinates_ = true;
    add_texture(e, name, t, coordinates_, is_number, p_.place(name));
}

Element BsdfMaker::two_sided(Element inner) const {
    Element e = object_in(inner, "twosided");
    reader::add(e, std::move(inner));
    return e;
}

// Normal and bump maps stand around `twosided`, so that the back is the other side of the same bent surface and not its
// mirror image.
Element BsdfMaker::with_normals(Element inner) {
    const std::optional<std::string> map = p_.text("normalmap");
    const std::optional<TextureValue> displacement = textures_.find_texture(p_, "displacement", true);
    if (map && displacement)
        p_.complain("normalmap", fmt::format("{} has a normalmap and a displacement, expected one of them", p_.title()));
    if (p_.is_wrong()) return inner;
    if (map) {
        Picture picture = find_picture(*map, p_.place("normalmap"), importer_);
        picture.raw = true;
        Element e = object_in(inner, "normalmap");
        add(e, "normalmap", {picture});
        add_boolean(e, "flip_invalid_normals", false, p_.place());
        add_boolean(e, "use_shadowing_function", false, p_.place());
        reader::add(e, std::move(inner));
        return e;
    }
    if (displacement && !displacement->constant()) {
        if (!std::holds_alternative<Picture>(displacement->value))
            throw InputError(p_.place("displacement"),
                             fmt::format("displacement of {} is a checkerboard, expected a picture", p_.title()));
        Element e = object_in(inner, "bumpmap");
        add(e, "bump_texture", *displacement, true);
        add_boolean(e, "flip_invalid_normals", false, p_.place());
        add_boolean(e, "use_shadowing_function", false, p_.place());
        reader::add(e, std::move(inner));
        return e;
    }
    return inner;
}

}  // namespace neumann::reader::pbrt
