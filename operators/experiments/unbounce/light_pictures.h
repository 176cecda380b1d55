// Pictures of one scene under separate lights.
#pragma once

#include "core/image/image.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace neumann {

struct RegionParts;

// Functions that return the pictures may be called several times, so that only one picture need be in memory.
struct LightPictures {
    std::vector<std::string> names;                    // names of the lights, for messages; at least two
    std::function<Estimate(std::size_t)> picture;      // W·m⁻²·sr⁻¹; without standard errors if they are not known
    std::function<Estimate(std::size_t)> direct = {};  // the part that has bounced once; empty: not known
    const RegionParts* parts = nullptr;                // null: the errors of pictures are independent of each other

    std::size_t lights() const { return names.size(); }
};

// The picture of a light. Throws InputError, beginning with its name, if it is not of this size or not finite.
Estimate checked_picture(const LightPictures& pictures, std::size_t light, int width, int height);
Estimate checked_direct(const LightPictures& pictures, std::size_t light, int width, int height);

}  // namespace neumann
