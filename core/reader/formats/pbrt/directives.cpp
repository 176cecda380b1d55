// The directives themselves.
#include "core/base/did_you_mean.h"
#include "core/reader/formats/pbrt/directive_reader.h"
#include "core/reader/formats/pbrt/transforms.h"
#include "core/reader/meshes/mesh_text.h"
#include "core/reader/xml/transform.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader::pbrt {

void DirectiveReader::add_options() {
    const auto set = [&](const char* name, std::optional<Entity>& option, const char* noun) {
        before_world(name, [this, &option, noun](const std::string& directive, const Location& place) {
            set_option(option, directive, place, noun);
        });
    };
    set("Film", scene_.film, "film");
    set("Sampler", scene_.sampler, "sampler");
    set("Integrator", scene_.integrator, "integrator");
    set("PixelFilter", scene_.filter, "pixel filter");
    before_world("Camera", [this](auto&, const Location& place) { camera(place); });
    // An accelerator is how pbrt finds what rays meet.
    before_world("Accelerator", [this](auto& word, const Location& place) { entity(word, place, "accelerator"); });
    before_world("Option", [this](auto&, const Location& place) { option(place); });
    anywhere("ColorSpace", [this](auto& word, const Location& place) {
        const std::string name = string_argument(word, place, "a name");
        if (name != "srgb" && name != "sRGB")
            problems_.replace(Unknown(place, fmt::format("ColorSpace is '{}'", printable(name)),
                                      ", expected srgb; the others are not supported", "taken as srgb"),
                              place);
    });
    anywhere("WorldBegin", [this](auto&, const Location& place) {
        if (is_in_world_) throw InputError(place, "a second WorldBegin");
        is_in_world_ = true;
        state_.to_world = Mat4(1.0);
        coordinate_systems_["world"] = Mat4(1.0);
    });
}

void DirectiveReader::add_state_directives() {
    for (const char* name : {"Identity", "Translate", "Scale", "Rotate", "LookAt", "Transform", "ConcatTransform"})
        anywhere(name, [this](const std::string& word, const Location& place) {
            const std::vector<double> numbers = number_arguments(word, place, *transform_size(word));
            const Mat4 moved = transformed_by(word, numbers, state_.to_world, place);
            if (!state_.moves_end_only) state_.to_world = moved;
        });
    anywhere("CoordinateSystem", [this](auto& word, const Location& place) {
        coordinate_systems_[string_argument(word, place, "a name")] = state_.to_world;
    });
    anywhere("CoordSysTransform", [this](auto& word, const Location& place) {
        const std::string name = string_argument(word, place, "a name");
        const auto found = coordinate_systems_.find(name);
        std::vector<std::string> known;
        for (const auto& [other, to_world] : coordinate_systems_) known.push_back(other);
        if (found == coordinate_systems_.end())
            throw InputError(place,
                             fmt::format("there is no coordinate system '{}'{}", printable(name), did_you_mean(name, known)));
        if (!state_.moves_end_only) state_.to_world = found->second;
    });
    // The times matter only if something moves.
    anywhere("TransformTimes", [this](auto& word, const Location& place) { number_arguments(word, place, 2); });
    anywhere("ActiveTransform", [this](auto& word, const Location& place) {
        const std::optional<Token> which = tokens().next();
        const bool is_known = which && (which->is("All") || which->is("StartTime") || which->is("EndTime"));
        if (!is_known) throw InputError(place, fmt::format("{} without All, StartTime or EndTime", word));
        if (!which->is("All"))
            problems_.replace(Unknown(place, fmt::format("{} {}: motion is not supported", word, which->text), "",
                                      "what moves stands where it is when the shutter opens"),
                              place);
        state_.moves_end_only = which->is("EndTime");
    });
    anywhere("ReverseOrientation", [this](auto&, const Location&) { state_.reversed = !state_.reversed; });
    anywhere("AttributeBegin", [this](auto&, const Location& place) { push('a', place); });
    anywhere("AttributeEnd", [this](auto& word, const Location& place) { pop('a', word, place); });
    anywhere("TransformBegin", [this](auto&, const Location& place) { push('t', place); });
    anywhere("TransformEnd", [this](auto& word, const Location& place) { pop('t', word, place); });
    anywhere("Attribute", [this](auto&, const Location& place) { attribute(place); });
}

void DirectiveReader::add_world_directives() {
    in_world("Material", [this](auto&, const Location& place) { material(place); });
    in_world("MakeNamedMaterial", [this](auto&, const Location& place) { named_material(place); });
    in_world("NamedMaterial", [this](auto& word, const Location& place) {
        state_.material = {string_argument(word, place, "a name"), 0, place};
    });
    in_world("Texture", [this](auto&, const Location& place) { texture(place); });
    in_world("LightSource",
             [this](auto& word, const Location& place) { scene_.lights.push_back(entity(word, place, "light", "light")); });
    in_world("AreaLightSource", [this](auto&, const Location& place) { area_light(place); });
    in_world("Shape", [this](auto&, const Location& place) { shape(place); });
    in_world("ObjectBegin", [this](auto&, const Location& place) { object_begin(place); });
    in_world("ObjectEnd", [this](auto&, const Location& place) { object_end(place); });
    in_world("ObjectInstance", [this](auto&, const Location& place) { object_instance(place); });
    anywhere("MakeNamedMedium", [this](auto& word, const Location& place) {
        const std::string name = string_argument(word, place, "a name");
        media_.insert(name);
        parameters("medium", place);
        problems_.replace(Unknown(place, fmt::format("medium '{}': media are not supported", printable(name)), "", "left out"),
                          place);
    });
    anywhere("MediumInterface", [this](auto&, const Location& place) { medium_interface(place); });
    anywhere("Include", [this](auto& word, const Location& place) { include(word, place); });
    in_world("Import", [this](auto& word, const Location& place) { include(word, place); });
}

void DirectiveReader::set_option(std::optional<Entity>& option, const std::string& directive, const Location& place,
                                 const std::string& noun) {
    Entity e = entity(directive, place, noun);
    if (option) throw InputError(place, fmt::format("a second {}, the first is at {}", directive, to_string(option->place())));
    option = std::move(e);
}

void DirectiveReader::option(const Location& place) {
    Parameters p = parameters("Option", place);
    // These say how samples are placed and what is reported.
    p.ignore({"disabletexturefiltering", "disablewavelengthjitter", "displacementedgescale", "msereferenceimage", "msereferenceout",
              "pixelstats", "rendercoordsys", "seed", "wavefront"});
    for (const char* name : {"disablepixeljitter", "forcediffuse"})
        if (p.boolean(name).value_or(false)) p.refuse(name, fmt::format("{} is not supported", name));
    p.finish();
}

void DirectiveReader::camera(const Location& place) {
    if (!is_invertible(state_.to_world)) {
        problems_.add(InputError(place, "the transformation of the camera has no inverse, expected one that scales nothing to 0"),
                      place);
        state_.to_world = Mat4(1.0);
    }
    set_option(scene_.camera, "Camera", place, "camera");
    coordinate_systems_["camera"] = glm::inverse(state_.to_world);
}

void DirectiveReader::attribute(const Location& place) {
    const std::string target = string_argument("Attribute", place, "what it is about");
    static const std::vector<std::string> targets = {"light", "material", "medium", "shape", "texture"};
    const Parameters p = parameters(fmt::format("Attribute '{}'", printable(target)), place);
    if (std::find(targets.begin(), targets.end(), target) == targets.end())
        throw InputError(place, fmt::format("Attribute '{}'; {}", printable(target), allowed_instead(target, targets)));
    auto& known = state_.defaults[target];
    std::vector<Parameter> all = known ? *known : std::vector<Parameter>();
    for (const Parameter& given : p.all()) {
        std::erase_if(all, [&](const Parameter& other) { return other.name == given.name; });
        all.push_back(given);
    }
    known = std::make_shared<const std::vector<Parameter>>(std::move(all));
}

void DirectiveReader::material(const Location& place) {
    scene_.materials.push_back({entity("Material", place, "material", "material"), ""});
    state_.material = {"", scene_.materials.size() - 1, place};
}

void DirectiveReader::named_material(const Location& place) {
    const std::string name = string_argument("MakeNamedMaterial", place, "a name");
    Parameters p = parameters(fmt::format("material '{}'", printable(name)), place, "material");
    if (name.empty()) throw InputError(place, "the name of a material is empty");
    const auto [known, is_new] = named_materials_.try_emplace(name, place);
    if (!is_new)
        throw InputError(place,
                         fmt::format("a second material '{}', the first is at {}", printable(name), to_string(known->second)));
    const std::optional<std::string> type = p.text("type");
    if (!type && !p.is_spoilt("type")) p.complain("type", fmt::format("material '{}' has no \"string type\"", printable(name)));
    scene_.materials.push_back({{type.value_or(""), std::move(p), state_.to_world}, name});
}

void DirectiveReader::texture(const Location& place) {
    const std::string name = string_argument("Texture", place, "a name"),
                      kind = string_argument("Texture", place, "float or spectrum");
    const std::string type = string_argument("Texture", place, "a type");
    Parameters p = parameters(fmt::format("texture '{}'", printable(type)), place, "texture");
    if (kind != "float" && kind != "spectrum")
        throw InputError(place,
                         fmt::format("texture '{}' is of '{}', expected float or spectrum", printable(name), printable(kind)));
    scene_.textures.push_back({{type, std::move(p), state_.to_world}, name, kind == "float"});
}

void DirectiveReader::area_light(const Location& place) {
    scene_.area_lights.push_back(entity("AreaLightSource", place, "area light", "light"));
    state_.light = scene_.area_lights.size() - 1;
}

void DirectiveReader::shape(const Location& place) {
    ShapeEntity shape{entity("Shape", place, "shape", "shape"), state_.reversed, state_.material, state_.light};
    if (object_ && shape.light) {
        warnings_.add("area light in an object: instances do not emit, as in pbrt");
        shape.light.reset();
    }
    (object_ ? object_->shapes : scene_.shapes).push_back(std::move(shape));
}

void DirectiveReader::object_begin(const Location& place) {
    const std::string name = string_argument("ObjectBegin", place, "a name");
    push('o', place);
    if (object_) throw InputError(place, "ObjectBegin within another one");
    const auto [known, is_new] = scene_.objects.try_emplace(name, PbrtScene::Object{place});
    object_ = &known->second;
    if (!is_new)
        throw InputError(place,
                         fmt::format("a second object '{}', the first is at {}", printable(name), to_string(known->second.place)));
}

void DirectiveReader::object_end(const Location& place) {
    pop('o', "ObjectEnd", place);
    object_ = nullptr;
}

void DirectiveReader::object_instance(const Location& place) {
    const std::string name = string_argument("ObjectInstance", place, "a name");
    if (object_) throw InputError(place, "ObjectInstance within an object, which pbrt does not allow");
    scene_.instances.push_back({name, state_.to_world, place});
}

void DirectiveReader::medium_interface(const Location& place) {
    std::vector<std::string> names = {string_argument("MediumInterface", place, "a name")};
    if (tokens().peek() && tokens().peek()->is_string) names.push_back(tokens().next()->text);
    // A medium that the file defines has been reported at its definition.
    for (const std::string& name : names)
        if (!name.empty() && !media_.contains(name))
            problems_.replace(Unknown(place, fmt::format("medium '{}': media are not supported", printable(name)), "", "ignored"),
                              place);
}

}  // namespace neumann::reader::pbrt
