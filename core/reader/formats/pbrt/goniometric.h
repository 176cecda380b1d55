// Makes a "goniometric" light, a point light whose intensity is given by a picture of all directions, as six <emitter
// type="projector">.
#pragma once

#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/formats/pbrt/texture_values.h"
#include "core/reader/xml/element.h"

#include <vector>

namespace neumann::reader::pbrt {

// `intensity` is that of a direction in which the picture is 1. `to_world` is rigid and maps from the space of the
// picture, in which its middle is +z.
std::vector<Element> make_projectors(const Picture& square, const Rgb& intensity, const Mat4& to_world, const Location& place,
                                     Importer& importer);

}  // namespace neumann::reader::pbrt
