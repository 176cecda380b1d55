// Mistakes that show in pixels whose light is sure: what the camera sees of lamps, directly or in mirrors.
#pragma once

#include "operators/experiments/blame/suspects.h"

#include <string>
#include <vector>

namespace neumann {

// A mistake that such pixels go along with.
struct SureCause {
    std::string words;
    double left = 1.0;
    bool is_found() const { return !words.empty(); }
};

// Of each term. What moves pixels shows in what the camera sees of lamps, and so does what changes bounce 0 alone; what
// reflections by mirrors lack in those.
std::vector<SureCause> find_sure_causes(ExpectedPictures& expected, const std::vector<ComparedTerm>& compared, bool are_sums);

}  // namespace neumann
