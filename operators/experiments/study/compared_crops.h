// Crops of the sum of bounces, by each method with its largest budget, and their errors.
#pragma once

#include "operators/experiments/study/differing_places.h"
#include "operators/experiments/study/study_points.h"

namespace neumann {

struct MethodCrop {
    std::size_t method;
    Image picture;   // of its first repeat
    Image errors;    // error_map() of all its repeats
    WithError rmse;  // over the crop, with the errors of repeats and of the reference
};

struct ComparedCrop {
    Crop place;
    bool is_given = false;  // false: found by its differences
    Estimate reference;
    std::vector<MethodCrop> methods;
};

// The given crops, which must be within the picture, and then `found` more in which methods differ most. `picture(n)`
// reads the sum of the n-th run. Methods without a point are left out.
std::vector<ComparedCrop> compare_crops(const std::vector<StudyRun>& runs, const std::vector<StudyPoint>& points,
                                        const StudyPlan& plan, const Estimate& reference, const std::vector<Crop>& given,
                                        std::size_t found, const std::function<Image(std::size_t n)>& picture);

}  // namespace neumann
