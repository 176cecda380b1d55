// Reads how bright lights are.
#pragma once

#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/formats/pbrt/texture_values.h"

namespace neumann::reader::pbrt {

// Reads the parameter `scale`, which must be at least 0.
double read_scale(Parameters& p);
// Reads `power` or `illuminance`; 0 if it is missing or, as in pbrt, not positive.
double read_positive(Parameters& p, const std::string& name);
// The mean luminance of the texels.
double mean_luminance(const Picture& picture, Importer& importer);

}  // namespace neumann::reader::pbrt
