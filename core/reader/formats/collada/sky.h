// The ambient light of the courses' program: the same radiance from all directions above the horizon.
#pragma once

#include "core/reader/xml/raw_scene.h"

namespace neumann::reader::collada {

// An <emitter type="envmap">, whose picture is added to the files in memory. `up`: an axis, 0 to 2. The horizon is as wide as a row
// of the picture, which makes the irradiance on a horizontal surface too small by 6·10⁻⁶ of it.
Element make_sky(const Rgb& radiance, int up, const Location& place, RawScene& scene);

}  // namespace neumann::reader::collada
