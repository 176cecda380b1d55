// What a study judges its methods by: an answer known exactly, the pictures of an earlier render, or pictures of its own, which are
// kept for later studies in $XDG_CACHE_HOME/neumann, or ~/.cache/neumann.
#pragma once

#include "apps/commands/study_command.h"
#include "operators/study/study_plan.h"

#include <nlohmann/json.hpp>

namespace neumann {

struct StudyReference {
    std::vector<Estimate> pictures;   // bounces 0 … N, and their sum; without standard errors where they are exact
    std::string description;          // in words
    std::string choice;               // why this method, where none was asked for
    nlohmann::ordered_json identity;  // tells it from others, and how it is made again
    std::vector<std::string> warnings;
    bool exact = false, from_cache = false;
    double seconds = 0.0;  // that it took
};

// The answer or the pictures that were given; nothing where a method is to make them. Throws InputError where it is none of these,
// or of another size.
std::optional<StudyReference> given_reference(const StudyRequest& request, const Film& film, int bounces);
// By the method asked for, or from the cache; nothing where it was interrupted.
std::optional<StudyReference> make_reference(const StudyRequest& request, std::uint64_t samples, const Scene& scene,
                                             const Pilot& pilot, int bounces);

}  // namespace neumann
