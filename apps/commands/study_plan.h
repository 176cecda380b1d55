// What a study is to do: its methods, how much each of them is given for each budget, and how a single run is done.
#pragma once

#include "apps/commands/study_command.h"
#include "operators/methods/render.h"
#include "operators/study/effort.h"

#include <string>
#include <vector>

namespace neumann {

struct StudyMethod {
    std::string name;  // as given
    Method method;
};

// A method as read_method() reads it. Throws InputError where it is unknown, or has no place in a study.
Method studied_method(const std::string& word);
// Throws InputError where one is unknown, given twice, or there is none.
std::vector<StudyMethod> study_methods(const StudyRequest& request);

// Nothing where the run was interrupted. Errors name the method.
std::optional<BounceSeries> run_method(const StudyMethod& method, const Effort& effort, int bounces, std::uint64_t seed,
                                       const Scene& scene, const Pilot& pilot);

struct StudyPlan {
    std::vector<double> budgets;  // seconds of a run, or samples a pixel
    bool budgets_are_samples = false;
    std::vector<std::vector<Effort>> efforts;  // method by method, budget by budget
    std::uint64_t reference_samples = 0;       // of a reference that is made
};

// After short runs that measure how fast each method is; they also find what a method refuses. Nothing where it was interrupted.
std::optional<StudyPlan> plan_study(const StudyRequest& request, const std::vector<StudyMethod>& methods, const Scene& scene,
                                    const Pilot& pilot, int bounces);

}  // namespace neumann
