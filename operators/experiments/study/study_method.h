// A method of a study, and a single run of it.
#pragma once

#include "operators/experiments/study/effort.h"
#include "operators/experiments/study/own_estimator.h"
#include "operators/render/methods/render.h"

#include <string>

namespace neumann {

struct StudyMethod {
    std::string name;  // as given
    Method method;
    OwnEstimator own = {};  // used instead of the method, if it is set
};

// Reads a method like read_method(). Throws InputError if it is unknown or has no place in a study.
Method studied_method(const std::string& word);

// Returns nothing if `watch` stops it. Errors name the method.
std::optional<BounceSeries> run_method(const StudyMethod& method, const Effort& effort, int bounces, std::uint64_t seed,
                                       const Scene& scene, const Pilot& pilot, const Watch& watch, Saving saving = {});

}  // namespace neumann
