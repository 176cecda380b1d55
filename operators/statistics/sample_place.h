// Which sample it was, so that it can be traced again, and where it counted. Pixels are numbered row by row within the crop.
#pragma once

#include <compare>
#include <cstdint>

namespace neumann {

// The paths of a pixel are numbered; to each pixel belong as many from the lights as from the camera.
struct SampleName {
    std::uint32_t pixel = 0;
    std::uint64_t sample = 0;
    auto operator<=>(const SampleName&) const = default;
};

// What comes from the lights counts for other pixels than its own.
struct SamplePlace {
    std::uint32_t pixel = 0;
    SampleName name;
    auto operator<=>(const SamplePlace&) const = default;
};

}  // namespace neumann
