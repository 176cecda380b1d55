#include "core/reader/formats/pbrt/area_lights.h"

#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/pbrt/colours.h"
#include "core/reader/formats/pbrt/light_scale.h"
#include "core/reader/meshes/mesh_text.h"

#include <numbers>

#include <fmt/format.h>

namespace neumann::reader::pbrt {

AreaLight read_area_light(Entity& e, Importer& importer) {
    if (e.type != "diffuse")
        throw Unknown(e.place(), fmt::format("area light type '{}' is not supported", printable(e.type)), "; allowed: diffuse",
                      "left out");
    Parameters& p = e.parameters;
    AreaLight light;
    light.place = e.place();
    const std::optional<Rgb> colour = find_light_colour(p, "L", importer);
    const std::optional<std::string> filename = p.text("filename");
    if (filename && colour) p.complain("filename", fmt::format("{} has L and filename, expected one of them", p.title()));
    const double scale = read_scale(p) * importer.imaging_ratio;
    if (const double power = read_positive(p, "power"); power > 0.0) light.power = power;
    light.two_sided = p.boolean("twosided").value_or(false);
    p.finish();
    if (p.is_wrong()) throw AlreadyReported();
    light.radiance = {colour.value_or(Rgb(1.0)) * scale};
    if (filename) {
        Picture picture = find_picture(*filename, p.place("filename"), importer);
        picture.nearest = true;
        light.mean = mean_luminance({picture}, importer);
        light.radiance = {picture};
        if (scale != 1.0)
            light.radiance = apply(
                light.radiance, [scale](const Rgb& c) { return scale * c; }, importer);
    }
    return light;
}

Element AreaLight::emitter(double area, Coordinates coordinates, Importer& importer) const {
    TextureValue value = radiance;
    if (power) {
        const double factor = *power / (mean * (two_sided ? 2.0 : 1.0) * area * std::numbers::pi);
        if (!(area > 0.0) || !std::isfinite(factor))
            throw InputError(place,
                             fmt::format("the power {} of an area light is on a shape of area {}, whose radiance is beyond the "
                                         "range of numbers",
                                         *power, area));
        value = apply(
            value, [factor](const Rgb& c) { return factor * c; }, importer);
    }
    Element e = make_object("emitter", "area", place);
    add_texture(e, "radiance", value, coordinates, false, place);
    return e;
}

}  // namespace neumann::reader::pbrt
