// How bright lights are.
#pragma once

#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/formats/pbrt/texture_values.h"

namespace neumann::reader::pbrt {

// The parameter `scale`, at least 0.
double read_scale(Parameters& p);
// `power` or `illuminance`; 0 if it is not given, or not positive, as in pbrt.
double read_positive(Parameters& p, const std::string& name);
// The mean luminance of the texels.
double mean_luminance(const Picture& picture, Importer& importer);

}  // namespace neumann::reader::pbrt
