// The sky that the courses' program has as ambient light: the same radiance from all directions above the horizon.
#pragma once

#include "core/reader/xml/raw_scene.h"

namespace neumann::reader::collada {

// Makes an <emitter type="envmap"> and adds its picture to the files in memory. `up` is the index of an axis. At the horizon the
// sky ends over a row of the picture, which makes the irradiance on a horizontal surface too small by a fraction of 6·10⁻⁶.
Element make_sky(const Rgb& radiance, int up, const Location& place, RawScene& scene);

}  // namespace neumann::reader::collada
