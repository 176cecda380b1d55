// Parameters that may vary over a surface: a colour or a number, and what stands in its place.
#pragma once

#include "core/material/surface_function.h"
#include "core/reader/color.h"
#include "core/reader/context.h"

namespace neumann::reader {

// A colour; `missing` in all channels where it is not given.
SurfaceFunction read_color_texture(Properties& p, const std::string& name, double missing, Illuminant illuminant,
                                   const Context& context);
// A number, in all channels.
SurfaceFunction read_number_texture(Properties& p, const std::string& name, double missing, const Context& context);

}  // namespace neumann::reader
