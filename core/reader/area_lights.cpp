#include "core/reader/area_lights.h"

#include "core/reader/textures.h"

namespace neumann::reader {

int AreaLights::index(const Element& e) {
    if (e.attribute("type").value != "area") fail_type(e, {"area"});
    const auto known = index_.find(&e);
    if (known != index_.end()) return known->second;
    Properties p(e, context_.objects);
    if (const auto texture = find_color_texture(p, "radiance", Illuminant::equal_energy, context_)) {
        lights_.emplace_back([f = *texture](const ShadingPoint& at, const Vec3&) { return f(at); }, texture->upper_bound());
    } else {
        const Element& radiance = p.require("radiance", color_types);
        lights_.emplace_back(parse_color(p, "radiance", radiance, Illuminant::equal_energy, context_.warnings));
    }
    p.number("sampling_weight");  // how often Mitsuba chooses it; changes noise only
    p.finish();
    return index_[&e] = static_cast<int>(lights_.size()) - 1;
}

}  // namespace neumann::reader
