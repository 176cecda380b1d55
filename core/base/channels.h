// One number in place of three where all channels are alike: what Rgb answers, asked of it.
#pragma once

#include "core/base/vec.h"

#include <type_traits>

namespace neumann {

// A colour as it is computed with: Rgb, or a double that stands for three equal channels.
template <class Colour>
concept ColourChannels = std::is_same_v<Colour, Rgb> || std::is_same_v<Colour, double>;

inline double max_component(double c) { return c; }
inline bool is_black(double c) { return c == 0.0; }
inline bool is_finite(double c) { return std::isfinite(c); }

template <ColourChannels Colour>
Colour channels_of(const Rgb& c) {
    if constexpr (std::is_same_v<Colour, Rgb>)
        return c;
    else
        return c.r;
}

}  // namespace neumann
