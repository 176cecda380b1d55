// Makes each type of material.
#include "core/reader/formats/pbrt/bsdf_maker.h"
#include "core/reader/formats/pbrt/colours.h"
#include "core/reader/formats/pbrt/named_spectra.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace neumann::reader::pbrt {

namespace {

// The metal's name if both spectra are those of a metal that Mitsuba knows as well.
std::optional<std::string> common_metal(Parameters& p, const std::string& prefix) {
    const auto name = [&](const std::string& parameter, const char* missing) {
        const Parameter* given = p.find(prefix + parameter, {"spectrum"});
        if (!given) return p.has(prefix + parameter) ? std::string() : std::string(missing);
        return given->texts.size() == 1 ? given->texts.front() : std::string();
    };
    const auto eta = metal(name("eta", "metal-Cu-eta")), k = metal(name("k", "metal-Cu-k"));
    if (!eta || !k || eta->is_k || !k->is_k || eta->metal != k->metal || eta->metal == "CuZn") return std::nullopt;
    return eta->metal;
}

// The k of a metal of η = 1 with this reflectance at normal incidence, as in pbrt.
Rgb k_of_reflectance(const Rgb& reflectance) {
    const Rgb r = glm::clamp(reflectance, 0.0, 0.9999);
    return 2.0 * glm::sqrt(r / (1.0 - r));
}

// The reflectance at normal incidence.
Rgb reflectance_of(const Rgb& eta, const Rgb& k) {
    return ((eta - 1.0) * (eta - 1.0) + k * k) / ((eta + 1.0) * (eta + 1.0) + k * k);
}

}  // namespace

Element BsdfMaker::make_diffuse() {
    Element e = bsdf("diffuse");
    add(e, "reflectance", reflectance("reflectance", 0.5));
    return two_sided(std::move(e));
}

BsdfMaker::Metal BsdfMaker::read_metal(const std::string& prefix) {
    const auto colour = textures_.find_reflectance(p_, "reflectance");
    const bool has_eta = p_.find(prefix + "eta", {"rgb", "spectrum"}), has_k = p_.find(prefix + "k", {"rgb", "spectrum"});
    if (colour && (has_eta || has_k))
        p_.complain("reflectance", fmt::format("{} has a reflectance and eta or k, expected either", p_.title()));
    Metal m;
    if (colour && !colour->constant()) {
        m.colour = at_most_one(*colour, importer_);
    } else if (colour) {
        m.eta = Rgb(1.0);
        m.k = k_of_reflectance(*colour->constant());
    } else {
        m.name = common_metal(p_, prefix);
        m.eta = find_metal_index(p_, prefix + "eta", importer_).value_or(metal("metal-Cu-eta")->value);
        m.k = find_metal_index(p_, prefix + "k", importer_).value_or(metal("metal-Cu-k")->value);
    }
    return m;
}

Element BsdfMaker::make_conductor() {
    const Alphas alphas = read_alphas("");
    const Metal m = read_metal("");
    Element e = bsdf(alphas.is_smooth ? "conductor" : "roughconductor");
    if (m.colour) {
        importer_.warnings.add("metal with a reflectance that varies: it does not grow towards grazing angles");
        add_string(e, "material", "none", p_.place());
        add(e, "specular_reflectance", *m.colour);
    } else if (m.name) {
        add_string(e, "material", *m.name, p_.place("eta"));
    } else {
        add_rgb(e, "eta", m.eta, p_.place("eta"));
        add_rgb(e, "k", m.k, p_.place("k"));
    }
    if (!alphas.is_smooth) add_alphas(e, alphas);
    return two_sided(std::move(e));
}

Element BsdfMaker::make_dielectric() {
    const double eta = index("eta", 1.5);
    const Alphas alphas = read_alphas("");
    const bool is_smooth = alphas.is_smooth || eta == 1.0;
    Element e = bsdf(is_smooth ? "dielectric" : "roughdielectric");
    add_float(e, "int_ior", eta, p_.place("eta"));
    add_float(e, "ext_ior", 1.0, p_.place());
    if (!is_smooth) add_alphas(e, alphas);
    return e;
}

Element BsdfMaker::make_thin_dielectric() {
    Element e = bsdf("thindielectric");
    add_float(e, "int_ior", index("eta", 1.5), p_.place("eta"));
    add_float(e, "ext_ior", 1.0, p_.place());
    return e;
}

// The material is a share 1 − w of a diffuse reflector and a share w of a sheet that only transmits, diffusely
// (`principledthin` with diff_trans 2): r = (1 − w) (r / (1 − w)) and t = w (t / w), which is exact. With w = max t /
// (max r + max t) both colours are at most max r + max t; pbrt cuts each off at 1, and not their sum.
Element BsdfMaker::make_diffuse_transmission() {
    const double scale = p_.number("scale", 1.0);
    if (scale < 0.0) p_.complain("scale", fmt::format("scale of {} is negative: {}", p_.title(), scale));
    const TextureValue r = reflectance("reflectance", 0.25), t = reflectance("transmittance", 0.25);
    const double most_r = std::min(max_component(largest(r, importer_)) * scale, 1.0),
                 most_t = std::min(max_component(largest(t, importer_)) * scale, 1.0);
    const double sum = most_r + most_t, most = std::max(sum, 1.0);
    if (sum > 1.0 + 1e-9)
        importer_.warnings.add("diffusetransmission: reflectance and transmittance add up to more than 1, as pbrt renders it");
    const auto times = [&](const TextureValue& value, double factor) {
        return factor == 1.0 && scale == 1.0
                   ? value
                   : apply(
                         value, [=](const Rgb& c) { return glm::min(glm::min(c * scale, 1.0) * factor, most); }, importer_);
    };
    Element reflecting = bsdf("diffuse");
    if (most_t == 0.0 || p_.is_wrong()) {
        add(reflecting, "reflectance", times(r, 1.0));
        return two_sided(std::move(reflecting));
    }
    Element transmitting = bsdf("principledthin");
    add(transmitting, "base_color", times(t, sum / most_t));
    add_float(transmitting, "diff_trans", 2.0, p_.place());
    if (most_r == 0.0) return transmitting;
    add(reflecting, "reflectance", times(r, sum / most_r));
    Element blend = bsdf("blendbsdf");
    add_float(blend, "weight", most_t / sum, p_.place());
    reader::add(blend, two_sided(std::move(reflecting)));
    reader::add(blend, std::move(transmitting));
    return blend;
}

// Reads the parameters of the layer that pbrt samples by random walks.
void BsdfMaker::check_layers() {
    p_.ignore({"maxdepth", "nsamples", "g", "thickness"});
    const auto albedo = textures_.find_reflectance(p_, "albedo");
    if (albedo && (!albedo->constant() || !is_black(*albedo->constant())))
        p_.refuse("albedo", fmt::format("albedo of {}: a medium within the layer is not supported", p_.title()));
}

Element BsdfMaker::make_coated_diffuse() {
    check_layers();
    const Alphas alphas = read_alphas("");
    const double eta = index("eta", 1.5);
    Element e = bsdf(alphas.is_smooth ? "plastic" : "roughplastic");
    add(e, "diffuse_reflectance", reflectance("reflectance", 0.5));
    add_float(e, "int_ior", eta, p_.place("eta"));
    add_float(e, "ext_ior", 1.0, p_.place());
    add_boolean(e, "nonlinear", true, p_.place());  // light reflected inwards is coloured again
    if (!alphas.is_isotropic)
        p_.refuse("vroughness", fmt::format("vroughness of {} is not uroughness, which is not supported", p_.title()),
                  ": its coat is alike in all directions");
    if (!alphas.is_smooth) add_alphas(e, {alphas.u, alphas.u, false, true});
    importer_.warnings.add("coateddiffuse: taken as 'plastic' or 'roughplastic', whose layer absorbs nothing");
    return two_sided(std::move(e));
}

// A coat of reflectance f on a metal of reflectance m in it, both at normal incidence, reflects f + (1 − f)² m / (1 − f
// m): a share f of a perfect mirror, and a share 1 − f of a metal of reflectance (1 − f) m / (1 − f m).
Element BsdfMaker::make_coated_conductor() {
    check_layers();
    const Alphas coat = read_alphas("interface."), metal = read_alphas("conductor.");
    const double eta = index("interface.eta", 1.5), f = (eta - 1.0) * (eta - 1.0) / ((eta + 1.0) * (eta + 1.0));
    const Metal base_metal = read_metal("conductor.");
    if (base_metal.colour) p_.complain("reflectance", fmt::format("reflectance of {} varies, expected a constant", p_.title()));
    const Rgb m = reflectance_of(base_metal.eta / eta, base_metal.k / eta);
    const auto lobe = [&](const Alphas& alphas) {
        Element e = bsdf(alphas.is_smooth ? "conductor" : "roughconductor");
        if (!alphas.is_smooth) add_alphas(e, alphas);
        return e;
    };
    Element base = lobe(metal), mirror = lobe(coat);
    add_rgb(base, "eta", Rgb(1.0), p_.place());
    add_rgb(base, "k", k_of_reflectance((1.0 - f) * m / (1.0 - f * m)), p_.place());
    add_string(mirror, "material", "none", p_.place());
    Element blend = bsdf("blendbsdf");
    add_float(blend, "weight", f, p_.place());
    reader::add(blend, std::move(base));
    reader::add(blend, std::move(mirror));
    importer_.warnings.add("coatedconductor: taken as a metal and a mirror in the shares of normal incidence");
    return two_sided(std::move(blend));
}

}  // namespace neumann::reader::pbrt
