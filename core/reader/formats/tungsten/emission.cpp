#include "core/reader/formats/tungsten/emission.h"

#include "core/reader/formats/make_elements.h"

#include <numbers>

namespace neumann::reader::tungsten {

std::optional<TextureValue> find_emission(JsonObject& primitive, Textures& textures, double of_unit_power) {
    const auto power = textures.find_color(primitive, "power"), emission = textures.find_color(primitive, "emission");
    const std::optional<TextureValue> found = power ? times(*power, of_unit_power) : emission;
    return found && !found->is_black() ? found : std::nullopt;
}

double radiance_of_unit_power(double area) { return area > 0.0 ? 1.0 / (std::numbers::pi * area) : 0.0; }

void add_area_light(Element& shape, const TextureValue& radiance, const Location& place) {
    Element emitter = make_object("emitter", "area", place);
    add_color(emitter, "radiance", radiance);
    add(shape, std::move(emitter));
}

}  // namespace neumann::reader::tungsten
