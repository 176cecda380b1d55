// The plan of a study: its methods, the effort of each method for each budget, and a single run.
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

// Parses a method with read_method(). Throws InputError if it is unknown or not allowed in a study.
Method studied_method(const std::string& word);
// Throws InputError if a method is unknown or given twice, or if there is none.
std::vector<StudyMethod> study_methods(const StudyRequest& request);

// Returns nothing if the run was interrupted. Errors name the method.
std::optional<BounceSeries> run_method(const StudyMethod& method, const Effort& effort, int bounces, std::uint64_t seed,
                                       const Scene& scene, const Pilot& pilot);

struct StudyPlan {
    std::vector<double> budgets;  // seconds per run, or samples per pixel
    bool budgets_are_samples = false;
    std::vector<std::vector<Effort>> efforts;  // method by method, budget by budget
    std::uint64_t reference_samples = 0;       // samples per pixel of the reference, if one is rendered
};

// Makes short runs that measure the speed of each method, and find out what a method refuses. Returns nothing if interrupted.
std::optional<StudyPlan> plan_study(const StudyRequest& request, const std::vector<StudyMethod>& methods, const Scene& scene,
                                    const Pilot& pilot, int bounces);

}  // namespace neumann
