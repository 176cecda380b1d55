// Finds mistakes that show in pixels whose light is sure: lamps that the camera sees, directly or in mirrors.
#pragma once

#include "operators/experiments/blame/suspects.h"

#include <string>
#include <vector>

namespace neumann {

// A mistake that agrees with such pixels.
struct SureCause {
    std::string words;
    double left = 1.0;
    bool is_found() const { return !words.empty(); }
};

// A cause for each term, or none. Mistakes that move pixels or change bounce 0 alone show in the lamps that the camera
// sees; missing reflections by mirrors show in the lamps seen there.
std::vector<SureCause> find_sure_causes(ExpectedPictures& expected, const std::vector<ComparedTerm>& compared, bool are_sums);

}  // namespace neumann
