#include "core/reader/area_lights.h"

#include "core/reader/color.h"

namespace neumann::reader {

int AreaLights::index(const Element& e) {
    if (e.attribute("type").value != "area") fail_type(e, {"area"});
    const auto known = index_.find(&e);
    if (known != index_.end()) return known->second;
    Properties p(e, context_.objects);
    const Element& radiance = p.require("radiance", color_types);
    const Rgb c = parse_color(p, "radiance", radiance, Illuminant::equal_energy, context_.warnings);
    p.finish();
    lights_.emplace_back(c);
    return index_[&e] = static_cast<int>(lights_.size()) - 1;
}

}  // namespace neumann::reader
