// The name of a sample, with which it can be traced again, and the pixel to which it contributed. Pixels are numbered row by row
// within the crop.
#pragma once

#include <compare>
#include <cstdint>

namespace neumann {

// A path is named by its pixel and its number there. A pixel has as many paths from the lights as from the camera.
struct SampleName {
    std::uint32_t pixel = 0;
    std::uint64_t sample = 0;
    auto operator<=>(const SampleName&) const = default;
};

// The place is a pixel of its own because a path from a light contributes to other pixels than the one that names it.
struct SamplePlace {
    std::uint32_t pixel = 0;
    SampleName name;
    auto operator<=>(const SamplePlace&) const = default;
};

}  // namespace neumann
