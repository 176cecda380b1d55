#include "core/reader/formats/gltf/make_bsdf.h"

#include "core/reader/formats/make_elements.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace neumann::reader::gltf {

namespace {

class BsdfMaker {
public:
    BsdfMaker(const Material& material, const OnMesh& mesh, Pictures& pictures, Warnings& warnings)
        : m_(material), mesh_(mesh), pictures_(pictures), warnings_(warnings) {}

    Element make() {
        Element e = basis();
        if (m_.normals) e = perturbed(std::move(e));
        if (m_.transmission.is_zero()) e = around("twosided", std::move(e));
        return masked(std::move(e));
    }

private:
    bool is_diffuse() const {
        return m_.specular == 0.0 && m_.metallic.is_zero() && m_.transmission.is_zero() && m_.clearcoat == 0.0 && m_.sheen == 0.0;
    }

    Element basis() {
        if (is_diffuse()) {
            Element e = make_object("bsdf", "diffuse", m_.place);
            add_base(e, "reflectance");
            return e;
        }
        return !m_.transmission.is_zero() && !m_.is_solid ? thin() : principled();
    }

    Element principled() {
        Element e = make_object("bsdf", "principled", m_.place);
        add_base(e, "base_color");
        add_amount(e, "roughness", m_.roughness);
        add_amount(e, "metallic", m_.metallic);
        if (!m_.transmission.is_zero()) add_amount(e, "spec_trans", m_.transmission);
        add_float(e, "eta", m_.transmission.is_zero() ? index_by_reflectance() : m_.eta, m_.place);
        if (m_.clearcoat > 0.0) {
            add_float(e, "clearcoat", m_.clearcoat, m_.place);
            add_float(e, "clearcoat_gloss", m_.clearcoat_gloss, m_.place);
        }
        if (m_.sheen > 0.0) add_float(e, "sheen", m_.sheen, m_.place);
        return e;
    }

    // A thin sheet, through which light goes straight on.
    Element thin() {
        warnings_.add(
            "KHR_materials_transmission without KHR_materials_volume: a thin sheet of glass, as glTF means it; a "
            "thicknessFactor above 0 makes it the surface of a solid body");
        Element e = make_object("bsdf", "principledthin", m_.place);
        add_base(e, "base_color");
        add_amount(e, "roughness", m_.roughness);
        add_amount(e, "spec_trans", m_.transmission);
        add_float(e, "eta", m_.eta, m_.place);
        if (!m_.metallic.is_zero()) warnings_.add("a thin sheet that lets light through: its metallicFactor left out");
        if (m_.clearcoat > 0.0) warnings_.add("a thin sheet that lets light through: its clearcoat left out");
        if (m_.sheen > 0.0) add_float(e, "sheen", m_.sheen, m_.place);
        return e;
    }

    // The index of a dielectric that reflects as much at normal incidence as the material. For metals it is above 1,
    // because Mitsuba's metals reflect nothing without a boundary.
    double index_by_reflectance() const {
        constexpr double largest = 0.99, least_of_metals = 1.0001;
        const double root = std::min(std::sqrt(m_.specular) * (m_.eta - 1.0) / (m_.eta + 1.0), largest);
        const double eta = m_.specular == 1.0 ? m_.eta : (1.0 + root) / (1.0 - root);
        return m_.metallic.is_zero() ? eta : std::max(eta, least_of_metals);
    }

    void add_base(Element& e, const std::string& name) {
        if (mesh_.has_colors) {
            Element& texture = add(e, make_object("texture", "mesh_attribute", m_.place));
            texture.attributes.push_back({"name", name, m_.place});
            add_string(texture, "name", "vertex_color", m_.place);
        } else if (m_.base_texture) {
            add(e, make_bitmap(*m_.base_texture, name, pictures_.colors(m_.base_texture->image, m_.base), false));
        } else {
            add_rgb(e, name, m_.base, m_.place);
        }
    }

    void add_amount(Element& e, const std::string& name, const Amount& amount) {
        if (!amount.texture || amount.is_zero())
            add_float(e, name, amount.factor, m_.place);
        else
            add(e,
                make_bitmap(*amount.texture, name, pictures_.channel(amount.texture->image, amount.channel, amount.factor), true));
    }

    Element around(const std::string& type, Element inner) const {
        Element e = make_object("bsdf", type, m_.place);
        add(e, std::move(inner));
        return e;
    }

    Element perturbed(Element inner) {
        const Texture& t = *m_.normals;
        if (!pictures_.is_known(t.image)) return inner;
        Element e = make_object("bsdf", "normalmap", m_.place);
        add(e, make_bitmap(t, "normalmap", pictures_.normals(t.image, t.amount, mesh_.is_mirrored), true));
        add(e, std::move(inner));
        return e;
    }

    Element masked(Element inner) {
        if (m_.alpha_mode == Material::Alpha::opaque) return inner;
        const bool is_cut_out = m_.alpha_mode == Material::Alpha::cut_out;
        const auto wrap = [&](const auto& add_opacity) {
            Element e = make_object("bsdf", "mask", m_.place);
            add_opacity(e);
            add(e, std::move(inner));
            return e;
        };
        if (!m_.base_texture || pictures_.is_opaque(m_.base_texture->image)) {
            const double opacity = is_cut_out ? (m_.alpha >= m_.cutoff ? 1.0 : 0.0) : m_.alpha;
            if (opacity == 1.0) return inner;
            return wrap([&](Element& e) { add_float(e, "opacity", opacity, m_.place); });
        }
        Texture texture = *m_.base_texture;
        if (is_cut_out) texture.is_nearest = true;  // nothing between the texels is half opaque
        const std::string name =
            is_cut_out ? pictures_.cut_out(texture.image, m_.alpha, m_.cutoff) : pictures_.channel(texture.image, 3, m_.alpha);
        return wrap([&](Element& e) { add(e, make_bitmap(texture, "opacity", name, true)); });
    }

    const Material& m_;
    const OnMesh mesh_;
    Pictures& pictures_;
    Warnings& warnings_;
};

}  // namespace

Element make_bsdf(const Material& material, const OnMesh& mesh, const std::string& id, Pictures& pictures, Warnings& warnings) {
    Element e = BsdfMaker(material, mesh, pictures, warnings).make();
    e.attributes.push_back({"id", id, material.place});
    return e;
}

Element make_emitter(const Material& m, Pictures& pictures, Warnings& warnings) {
    if (m.alpha_mode != Material::Alpha::opaque)
        warnings.add("a material that emits and has an alphaMode: it emits where it is transparent, too");
    Element e = make_object("emitter", "area", m.place);
    if (m.emission_texture && !pictures.is_known(m.emission_texture->image))
        add_rgb(e, "radiance", Rgb(0.0), m.place);
    else if (m.emission_texture)
        add(e, make_bitmap(*m.emission_texture, "radiance", pictures.colors(m.emission_texture->image, m.emission), false));
    else
        add_rgb(e, "radiance", m.emission, m.place);
    return e;
}

}  // namespace neumann::reader::gltf
