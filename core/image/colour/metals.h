// Refractive indices η + ik of measured metals, and of what Mitsuba has beside them, as linear sRGB.
#pragma once

#include "core/base/vec.h"

#include <span>
#include <string_view>

namespace neumann {

struct Metal {
    std::string_view name;
    Rgb eta, k;
};

// The spectra of Mitsuba's files ior/NAME.eta.spd and ior/NAME.k.spd (github.com/mitsuba-renderer/mitsuba-data; from luxpop.com:
// Palik, Handbook of Optical Constants of Solids, and atomic scattering factors of CXRO and LLNL), each made a colour by
// spectrum_to_rgb(…, Illuminant::equal_energy) and cut at 0, as Mitsuba's RGB modes do. Sorted by name.
std::span<const Metal> metals();

}  // namespace neumann
