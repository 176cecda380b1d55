// Reads "diffuse" area lights as <emitter type="area">.
#pragma once

#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/formats/pbrt/texture_values.h"
#include "core/reader/xml/element.h"

#include <optional>

namespace neumann::reader::pbrt {

struct AreaLight {
    TextureValue radiance{Rgb(1.0)};
    std::optional<double> power = {};  // power of each shape, which replaces the scale of `radiance`
    double mean = 1.0;                 // mean luminance of the picture; 1 without one, as in pbrt
    bool two_sided = false;
    Location place = {};

    // The emitter of a shape of this area; that of round shapes is in their own space.
    Element emitter(double area, Coordinates coordinates, Importer& importer) const;
};

// Throws InputError, or AlreadyReported if parameters are wrong.
AreaLight read_area_light(Entity& e, Importer& importer);

}  // namespace neumann::reader::pbrt
