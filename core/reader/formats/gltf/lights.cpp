#include "core/reader/formats/gltf/lights.h"

#include "core/reader/formats/make_elements.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace neumann::reader::gltf {

namespace {

void add_cone(Element& e, JsonObject& light) {
    constexpr double degrees = 180.0 / std::numbers::pi, right_angle = std::numbers::pi / 2.0;
    double inner = 0.0, outer = right_angle / 2.0;
    if (auto spot = light.object("spot")) {
        constexpr double rounding = 1e-6;
        inner = spot->number("innerConeAngle", inner, {0.0, right_angle});
        outer = std::min(spot->number("outerConeAngle", outer, {0.0, right_angle + rounding}), right_angle);
        spot->finish();
        if (!(inner <= outer) || outer == 0.0)
            throw InputError(spot->place_of("outerConeAngle"),
                             fmt::format("outerConeAngle is {}, expected more than innerConeAngle, {}", outer, inner));
    }
    if (inner < outer)
        light.notes().warnings.add("a spot light: between innerConeAngle and outerConeAngle it falls off linearly in the angle");
    add_float(e, "beam_width", inner * degrees, light.place());
    add_float(e, "cutoff_angle", outer * degrees, light.place());
}

}  // namespace

Element make_light(const Placed& placed, JsonObject light) {
    const std::string type = light.text("type").value_or("");
    const Rgb color = light.color("color", 1.0, not_negative) * (light.number("intensity", 1.0, not_negative) / lumens_per_watt);
    light.ignore({"name"});
    if (light.find_number("range")) light.notes().warnings.add("the range of a light left out: its light falls off with distance²");
    if (type != "point" && type != "spot" && type != "directional")
        throw Unknown(light.place_of("type"), fmt::format("type is '{}'", type), ", expected point, spot or directional",
                      "the light is left out");
    Element e = make_object("emitter", type, light.place());
    if (type == "point") {
        add_point(e, "position", Vec3(placed.to_world[3]), placed.place);
    } else {
        Mat4 to_world = without_scale(placed);  // glTF's lights look along −z, Mitsuba's along z
        to_world[0] = -to_world[0];
        to_world[2] = -to_world[2];
        add_matrix(e, "to_world", to_world, placed.place);
    }
    if (type == "spot")
        add_cone(e, light);
    else
        light.ignore({"spot"});
    add_rgb(e, type == "directional" ? "irradiance" : "intensity", color, light.place());
    light.finish();
    return e;
}

}  // namespace neumann::reader::gltf
