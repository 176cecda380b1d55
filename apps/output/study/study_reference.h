// The reference of a study: an exactly known answer, the pictures of an earlier render, or a reference that the study
// renders itself and caches for later studies in $XDG_CACHE_HOME/neumann or ~/.cache/neumann.
#pragma once

#include "apps/output/files/output_folder.h"
#include "apps/requests/study_request.h"
#include "operators/experiments/study/study_plan.h"

#include <nlohmann/json.hpp>

#include <functional>

namespace neumann {

struct StudyReference {
    std::vector<Estimate> pictures;   // bounces 0 … N, and their sum; without standard errors if they are exact
    std::string description;          // in words
    std::string choice;               // why this method was chosen, if none was given
    nlohmann::ordered_json identity;  // identifies the reference, and describes how to make it again
    std::vector<std::string> warnings;
    bool exact = false, from_cache = false;
    double seconds = 0.0;  // time to render it
};

// The given answer or pictures; nothing if a method is to render them. Throws InputError for others, and other sizes.
std::optional<StudyReference> given_reference(const StudyRequest& request, const Film& film, int bounces);
// Renders the reference with the given method, or takes it from the cache. Returns nothing if interrupted. Calls begins(identity)
// before it is rendered; its unfinished state is in the folder meanwhile. `crew`: processes that render with this one, or null.
std::optional<StudyReference> make_reference(const StudyRequest& request, std::uint64_t samples, const Scene& scene,
                                             const Pilot& pilot, int bounces, OutputFolder& folder, Crew* crew,
                                             const std::function<void(const nlohmann::ordered_json&)>& begins);

}  // namespace neumann
