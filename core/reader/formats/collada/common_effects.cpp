#include "core/image/display.h"
#include "core/reader/formats/collada/surface.h"
#include "core/reader/formats/collada/texts.h"
#include "core/reader/formats/collada/textures.h"
#include "core/reader/formats/make_elements.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace neumann::reader::collada {

namespace {

const std::array<std::string, 4> shaders = {"blinn", "constant", "lambert", "phong"};
const std::array<std::string, 11> slots = {"ambient",    "diffuse",      "emission",  "extra",    "index_of_refraction",
                                           "reflective", "reflectivity", "shininess", "specular", "transparency",
                                           "transparent"};

// Whether an effect has a bump or normal map, which is some program's own addition.
bool has_bumps(const Element& e) {
    return e.tag == "bump" || e.tag == "bumpmap" || e.tag == "normalmap" ||
           std::any_of(e.children.begin(), e.children.end(), has_bumps);
}

class CommonEffect {
public:
    CommonEffect(const Element& effect, const std::string& name, const Import& import)
        : effect_(effect), name_(name), import_(import), parameters_(effect) {}

    Surface read() {
        const Element& technique = required_child(required_child(effect_, "profile_COMMON"), "technique");
        shader_ = find_shader(technique);
        check_children(*shader_, slots, import_.problems);
        warn_of_what_is_left_out();
        add_emission();
        add_reflection();
        return std::move(surface_);
    }

private:
    struct Value {
        Color color;
        const Element* texture = nullptr;
        bool is_black() const { return !texture && neumann::is_black(color.rgb); }
    };

    static const Element* find_shader(const Element& technique) {
        for (const Element& e : technique.children)
            if (std::find(shaders.begin(), shaders.end(), e.tag) != shaders.end()) return &e;
        throw Unknown(technique.place, "<technique> has no shader", ", expected <blinn>, <constant>, <lambert> or <phong>",
                      "the material is taken as diffuse, of reflectance 0.5");
    }

    const Element* slot(const std::string& tag) const { return child(*shader_, tag); }

    // The value of <emission> or the like; nothing if it is missing, or (with a report) wrong.
    std::optional<Value> value(const std::string& tag) {
        const Element* e = slot(tag);
        if (!e) return std::nullopt;
        return import_.problems.attempt(e->place, [&] {
            if (const Element* texture = child(*e, "texture")) return Value{{}, texture};
            if (const Element* color = child(*e, "color")) return Value{read_color(*color)};
            const Element& parameter = parameter_of(required_child(*e, "param"));
            for (const char* type : {"float4", "float3"})
                if (const Element* color = child(parameter, type)) return Value{read_color(*color)};
            throw InputError(parameter.place, "<newparam> is no colour, expected <float3> or <float4>");
        });
    }

    std::optional<double> number(const std::string& tag) {
        const Element* e = slot(tag);
        if (!e) return std::nullopt;
        return import_.problems.attempt(e->place, [&] {
            if (const Element* number = child(*e, "float")) return read_number(*number);
            return read_number(required_child(parameter_of(required_child(*e, "param")), "float"));
        });
    }

    const Element& parameter_of(const Element& param) const {
        const Attribute& ref = required_attribute(param, "ref");
        return parameters_.find(ref.value, ref.place);
    }

    // Adds a colour or a picture as a parameter.
    void add_value(Element& to, const std::string& name, const Value& v, const Location& place) {
        if (!v.texture) return add_rgb(to, name, v.color.rgb, place);
        auto bitmap = import_.problems.attempt(place, [&] { return make_bitmap(*v.texture, name, parameters_, import_); });
        if (!bitmap) return;
        const Attribute* coordinates = v.texture->find("texcoord");
        surface_.coordinates.insert(coordinates ? coordinates->value : "");
        add(to, std::move(*bitmap));
    }

    void warn_of_what_is_left_out() {
        const auto warn = [&](const std::string& what) { import_.warnings.add(fmt::format("material '{}': {}", name_, what)); };
        number("shininess");
        number("index_of_refraction");
        if (const auto specular = value("specular"); specular && !specular->is_black() && shader_->tag != "lambert")
            warn("its highlights are left out: <specular> and <shininess> are no law of reflection");
        const std::optional<Value> reflective = value("reflective");
        if (number("reflectivity").value_or(reflective ? 1.0 : 0.0) > 0.0 && !(reflective && reflective->is_black()))
            warn("its mirror image, <reflective>, is left out");
        if (has_bumps(effect_)) warn("its bump map is left out, a program's own addition");
    }

    void add_emission() {
        const std::optional<Value> emission = value("emission");
        if (!emission || emission->is_black()) return;
        const Location& place = slot("emission")->place;
        surface_.emitter = make_object("emitter", "area", place);
        add_value(*surface_.emitter, "radiance", *emission, place);
    }

    void add_reflection() {
        std::optional<Value> diffuse = value("diffuse");
        // The course's program takes a missing <diffuse> as 0.5.
        if (!slot("diffuse") && import_.file.is_of_course()) diffuse = Value{{Rgb(0.5)}};
        const double opacity = read_opacity();
        if ((!diffuse || diffuse->is_black()) && opacity == 1.0 && surface_.emitter) return;
        const Location& place = slot("diffuse") ? slot("diffuse")->place : shader_->place;
        Element bsdf = make_object("bsdf", "diffuse", place);
        add_value(bsdf, "reflectance", diffuse.value_or(Value()), place);
        surface_.bsdf = two_sided(std::move(bsdf));
        if (opacity == 1.0) return;
        Element mask = make_object("bsdf", "mask", slot_place("transparency", "transparent"));
        add_float(mask, "opacity", opacity, mask.place);
        add(mask, std::move(*surface_.bsdf));
        surface_.bsdf = std::move(mask);
    }

    const Location& slot_place(const std::string& tag, const std::string& other) const {
        return slot(tag) ? slot(tag)->place : slot(other)->place;
    }

    // The opacity by COLLADA 1.5, chapter 7, "Determining transparency"; 1 if nothing is said about it.
    double read_opacity() {
        const std::optional<Value> transparent = value("transparent");
        const std::optional<double> transparency = number("transparency");
        if ((!transparent && !transparency) || (slot("transparent") && !transparent)) return 1.0;
        if (transparent && transparent->texture) {
            import_.warnings.add(fmt::format("material '{}' is taken as opaque: its <transparent> is a picture", name_));
            return 1.0;
        }
        const Element* e = slot("transparent");
        const Attribute* mode = e ? e->find("opaque") : nullptr;
        const std::string by = mode ? mode->value : "A_ONE";
        const Color color = transparent ? transparent->color : Color{Rgb(1.0), 1.0};
        const double factor = transparency.value_or(1.0);
        double opacity = 1.0;
        if (by == "A_ONE" || by == "A_ZERO") {
            opacity = by == "A_ONE" ? color.alpha * factor : 1.0 - color.alpha * factor;
        } else if (by == "RGB_ZERO" || by == "RGB_ONE") {
            if (!is_grey(color.rgb))
                import_.warnings.add(fmt::format("material '{}': its coloured <transparent> is taken as grey", name_));
            const double part = (is_grey(color.rgb) ? color.rgb.r : luminance(color.rgb)) * factor;
            opacity = by == "RGB_ONE" ? part : 1.0 - part;
        } else {
            import_.problems.add(
                InputError(mode->place, fmt::format("opaque is '{}', expected A_ONE, A_ZERO, RGB_ONE or RGB_ZERO", by)), e->place);
        }
        if (!(opacity >= 0.0 && opacity <= 1.0)) {
            const Location& place = slot_place("transparency", "transparent");
            import_.problems.add(InputError(place, fmt::format("the opacity is {}, expected from 0 to 1", opacity)), place);
            return 1.0;
        }
        if (opacity == 0.0) import_.warnings.add(fmt::format("material '{}' is fully transparent and cannot be seen", name_));
        return opacity;
    }

    const Element& effect_;
    const std::string& name_;
    const Import& import_;
    const Parameters parameters_;
    const Element* shader_ = nullptr;
    Surface surface_;
};

}  // namespace

Element two_sided(Element bsdf) {
    Element both = make_object("bsdf", "twosided", bsdf.place);
    add(both, std::move(bsdf));
    return both;
}

Element default_bsdf(const Location& place) {
    Element bsdf = make_object("bsdf", "diffuse", place);
    add_rgb(bsdf, "reflectance", Rgb(0.5), place);
    return two_sided(std::move(bsdf));
}

Surface read_common_effect(const Element& effect, const std::string& name, const Import& import) {
    return CommonEffect(effect, name, import).read();
}

}  // namespace neumann::reader::collada
