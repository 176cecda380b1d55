// "goniometric": a point light whose intensity is that of a picture of all directions, as six <emitter type="projector">.
#pragma once

#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/formats/pbrt/texture_values.h"
#include "core/reader/xml/element.h"

#include <vector>

namespace neumann::reader::pbrt {

// The `intensity` is that of a direction where the picture is 1. `to_world`: rigid, from the space of the picture, in which its
// middle is +z.
std::vector<Element> make_projectors(const Picture& square, const Rgb& intensity, const Mat4& to_world, const Location& place,
                                     Importer& importer);

}  // namespace neumann::reader::pbrt
