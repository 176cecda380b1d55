// "diffuse" area lights as <emitter type="area">.
#pragma once

#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/formats/pbrt/texture_values.h"
#include "core/reader/xml/element.h"

#include <optional>

namespace neumann::reader::pbrt {

struct AreaLight {
    TextureValue radiance{Rgb(1.0)};
    std::optional<double> power = {};  // of each shape, in place of what the scale of `radiance` says
    double mean = 1.0;                 // luminance of the picture; 1 without one, as in pbrt
    bool two_sided = false;
    Location place = {};

    // What a shape of this area (in its own space, for round ones) gives off.
    Element emitter(double area, Coordinates coordinates, Importer& importer) const;
};

// Throws InputError, or Told if parameters are wrong.
AreaLight read_area_light(Entity& e, Importer& importer);

}  // namespace neumann::reader::pbrt
