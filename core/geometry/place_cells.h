// A hashed grid over the places where something was learned: cubes whose size is a fraction of where most of the places are.
#pragma once

#include "core/base/vec.h"

#include <cstdint>
#include <span>

namespace neumann {

class PlaceCells {
public:
    PlaceCells() = default;
    // `along`: the number of cubes along the longest side of the box that holds the middle 98% of the places in each coordinate.
    PlaceCells(std::span<const Vec3> places, int along);

    // The number of the cube that holds x, wherever x is, with an own number below 2^16. Cubes that are 2^16 apart share theirs.
    std::uint64_t cell(const Vec3& x, std::uint64_t own) const;

private:
    double per_length_ = 0.0;
};

}  // namespace neumann
