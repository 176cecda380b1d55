#include "core/reader/plugins/area_lights.h"

#include "core/reader/plugins/textures.h"

namespace neumann::reader {

int AreaLights::index(const Element& e) {
    const auto known = index_.find(&e);
    if (known != index_.end()) return known->second;
    std::optional<AreaLight> light = context_.problems().attempt(e.place, [&] { return read(e); });
    if (!light) return index_[&e] = Emitters::none;
    lights_.push_back(std::move(*light));
    return index_[&e] = static_cast<int>(lights_.size()) - 1;
}

int AreaLights::index(const Element& e, const Shape& shape) {
    const int light = index(e);
    if (light == Emitters::none || !lights_[static_cast<std::size_t>(light)].along_normal || is_flat(shape)) return light;
    context_.problems().add(
        InputError(e.place,
                   "emitter 'directionalarea' on a shape that is not flat; expected a rectangle, a disk or a mesh in one plane"),
        e.place);
    return Emitters::none;
}

AreaLight AreaLights::read(const Element& e) const {
    if (!is_of_shapes(e)) fail_type(e, {"area", "directionalarea"}, "left out");
    const bool along_normal = e.attribute("type").value == "directionalarea";
    Properties p(e, context_.objects);
    std::optional<AreaLight> light;
    if (const auto texture = find_color_texture(p, "radiance", Illuminant::equal_energy, context_)) {
        light = texture->is_constant()
                    ? AreaLight(texture->upper_bound())
                    : AreaLight([f = *texture](const ShadingPoint& at, const Vec3&) { return f(at); }, texture->upper_bound());
    } else if (along_normal && !p.find("radiance", color_types)) {
        light = AreaLight(Rgb(1.0));
    } else {
        const Element& radiance = p.require("radiance", color_types);
        light = AreaLight(parse_color(p, "radiance", radiance, Illuminant::equal_energy, context_.warnings));
    }
    light->along_normal = along_normal;
    p.number("sampling_weight");  // how often Mitsuba chooses it; changes noise only
    p.finish();
    return *light;
}

}  // namespace neumann::reader
