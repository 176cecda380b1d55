// The amount of work that each method of a study does for each budget.
#pragma once

#include "operators/experiments/study/study_method.h"

#include <vector>

namespace neumann {

// The seconds of a run, ascending, or samples per pixel. If both are empty, seconds are chosen that suit all methods.
struct StudyBudgets {
    std::vector<double> seconds = {};
    std::vector<std::uint64_t> samples = {};
    std::optional<std::uint64_t> reference_samples =
        {};  // per pixel, for a reference that is rendered; the default depends on the budgets
};

struct StudyPlan {
    std::vector<double> budgets;  // seconds of a run, or samples a pixel
    bool budgets_are_samples = false;
    std::vector<std::vector<Effort>> efforts;  // method by method, budget by budget
    std::uint64_t reference_samples = 0;
    // The expected seconds: of all methods and budgets once, and of a reference by walk.
    double repeat_seconds = 0.0, reference_seconds = 0.0;
};

// Measures the speed of each method, and whether it refuses, by short runs. Returns nothing if it was stopped.
std::optional<StudyPlan> plan_study(const StudyBudgets& wanted, const std::vector<StudyMethod>& methods, int bounces,
                                    std::uint64_t seed, const Scene& scene, const Pilot& pilot, const Watch& watch);

}  // namespace neumann
