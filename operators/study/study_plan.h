// How much each method of a study is given for each budget.
#pragma once

#include "operators/study/study_method.h"

#include <vector>

namespace neumann {

// Seconds of a run, growing, or samples a pixel; of neither, seconds are chosen that suit all methods.
struct StudyBudgets {
    std::vector<double> seconds = {};
    std::vector<std::uint64_t> samples = {};
    std::optional<std::uint64_t> reference_samples = {};  // of a reference that is made; chosen without it
};

struct StudyPlan {
    std::vector<double> budgets;  // seconds of a run, or samples a pixel
    bool budgets_are_samples = false;
    std::vector<std::vector<Effort>> efforts;  // method by method, budget by budget
    std::uint64_t reference_samples = 0;
};

// After short runs that measure how fast each method is; they also find what a method refuses. Nothing where it was stopped.
std::optional<StudyPlan> plan_study(const StudyBudgets& wanted, const std::vector<StudyMethod>& methods, int bounces,
                                    std::uint64_t seed, const Scene& scene, const Pilot& pilot, const Stop& stop);

}  // namespace neumann
