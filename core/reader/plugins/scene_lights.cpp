#include "core/reader/plugins/scene_lights.h"

#include "core/reader/plugins/area_lights.h"
#include "core/reader/plugins/color.h"
#include "core/reader/plugins/light_images.h"
#include "core/reader/plugins/sensors.h"
#include "core/reader/plugins/sun_sky.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

Rgb read_light_color(Properties& p, const std::string& name, const Context& context) {
    const Element* e = p.find(name, color_types);
    return e ? parse_color(p, name, *e, Illuminant::equal_energy, context.warnings) : Rgb(1.0);
}

void finish(Properties& p) {
    p.number("sampling_weight");  // how often Mitsuba chooses it; changes noise only
    p.finish();
}

// Reads a parameter that stands in place of `to_world`; `name` stands first in Mitsuba's manual.
std::optional<Vec3> read_in_place_of_transform(Properties& p, const std::string& name) {
    const std::optional<Vec3> value = p.point(name);
    if (value && p.find("to_world", {"transform"}))
        p.complain(name, fmt::format("both {} and to_world are given, expected one of them", name));
    return value;
}

ConstantEnvironment read_constant(Properties& p, const Context& context) {
    const Rgb radiance = read_light_color(p, "radiance", context);
    p.transform("to_world");  // it looks the same from all sides
    finish(p);
    return ConstantEnvironment(radiance);
}

// As Mitsuba from 3.9.1 on, which had refused smaller pictures: the last column and the last row come again up to 2×3 pixels.
Image padded(Image image) {
    if (image.width >= 2 && image.height >= 3) return image;
    Image result(std::max(image.width, 2), std::max(image.height, 3));
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x)
            result.at(x, y) = image.at(std::min(x, image.width - 1), std::min(y, image.height - 1));
    return result;
}

EnvironmentMap read_envmap(Properties& p, const Context& context) {
    const Attribute& filename = p.require("filename", {"string"}).attribute("value");
    const double scale = read_scale(p, "scale");
    const Mat4 to_world = read_rigid_transform(p);
    p.boolean("mis_compensation");  // how Mitsuba draws directions; changes noise only
    std::optional<Image> read = p.attempt("filename", [&] { return read_light_image(filename, context); });
    finish(p);
    return EnvironmentMap(padded(std::move(*read)), scale, to_world);
}

PointLight read_point(Properties& p, const Context& context) {
    const std::optional<Vec3> position = read_in_place_of_transform(p, "position");
    const Mat4 to_world = p.transform("to_world");
    const Rgb intensity = read_light_color(p, "intensity", context);
    finish(p);
    return PointLight(position ? *position : Vec3(to_world[3]), intensity);
}

DirectionalLight read_directional(Properties& p, const Context& context) {
    const std::optional<Vec3> given = read_in_place_of_transform(p, "direction");
    const Mat4 to_world = p.transform("to_world");
    const Vec3 direction = given ? *given : Vec3(to_world[2]);
    const double largest = max_component(glm::abs(direction));
    if (largest == 0.0) p.complain("direction", "the direction is zero");
    const Rgb irradiance = read_light_color(p, "irradiance", context);
    finish(p);
    return DirectionalLight(glm::normalize(direction / largest), irradiance);
}

SpotLight read_spot(Properties& p, const Context& context) {
    const Rgb intensity = read_light_color(p, "intensity", context);
    const double cutoff = p.number("cutoff_angle").value_or(20.0), beam_width = p.number("beam_width").value_or(0.75 * cutoff);
    std::optional<Slide> slide = read_slide(p, "texture", context);
    const double most = slide ? 90.0 : 180.0;
    if (!(cutoff > 0.0 && (cutoff < most || (cutoff == most && !slide))))
        p.complain("cutoff_angle", fmt::format("cutoff_angle is {}, expected more than 0 and {} degrees", cutoff,
                                               slide ? "with a texture less than 90" : "at most 180"));
    if (!(beam_width >= 0.0 && beam_width <= cutoff))
        p.complain("beam_width",
                   fmt::format("beam_width is {}, expected at least 0 and at most cutoff_angle, {} degrees", beam_width, cutoff),
                   {"cutoff_angle"});
    const bool is_smooth = p.choice("falloff", {"linear", "smooth"}, "linear") == "smooth";
    const Mat4 to_world = p.transform("to_world");
    finish(p);
    return SpotLight(to_world, intensity, glm::radians(cutoff), glm::radians(beam_width), std::move(slide),
                     is_smooth ? SpotLight::Edge::smooth : SpotLight::Edge::linear);
}

ProjectorLight read_projector(Properties& p, const Context& context) {
    std::optional<Slide> slide = read_slide(p, "irradiance", context);
    if (!slide) {
        const Element& color = p.require("irradiance", color_types);
        slide.emplace(parse_color(p, "irradiance", color, Illuminant::equal_energy, context.warnings));
    }
    const double scale = read_scale(p, "scale");
    const FieldOfView field = read_field_of_view(p);
    const double half_width = tan_half_width(field.angle, field.axis, slide->aspect());
    const Mat4 to_world = read_rigid_transform(p);
    finish(p);
    return ProjectorLight(to_world, std::move(*slide), scale, half_width);
}

}  // namespace

double read_scale(Properties& p, const std::string& name) {
    const double scale = p.number(name).value_or(1.0);
    if (scale < 0.0) p.complain(name, fmt::format("{} is {}, expected at least 0", name, scale));
    return scale;
}

void SceneLights::add(const Element& e) {
    const std::string& type = e.attribute("type").value;
    if (is_of_shapes(e)) return;
    Properties p(e, context_.objects);
    if (type == "constant")
        set_environment(e, read_constant(p, context_));
    else if (type == "envmap")
        set_environment(e, read_envmap(p, context_));
    else if (type == "sunsky")
        set_environment(e, read_sunsky(p, context_));
    else if (type == "point")
        delta_.emplace_back(read_point(p, context_));
    else if (type == "directional")
        delta_.emplace_back(read_directional(p, context_));
    else if (type == "spot")
        delta_.emplace_back(read_spot(p, context_));
    else if (type == "projector")
        delta_.emplace_back(read_projector(p, context_));
    else
        fail_type(e, {"area", "constant", "directional", "directionalarea", "envmap", "point", "projector", "spot", "sunsky"},
                  "left out");
}

void SceneLights::set_environment(const Element& e, Environment environment) {
    if (environment_)
        throw InputError(e.place, fmt::format("a second light that surrounds the scene, expected only one; the first is at {}",
                                              to_string(environment_place_)));
    environment_ = std::move(environment);
    environment_place_ = e.place;
}

}  // namespace neumann::reader
