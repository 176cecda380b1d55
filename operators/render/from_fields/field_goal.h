// Chooses patches, directions and samples to reach a given error, or to use a given time: renders with few, finds out
// which part dominates the error, and renders again with more of that. Before each render it predicts time, memory and
// error, and it stops if the render does not fit or does not pay.
#pragma once

#include "operators/render/from_fields/field_pictures.h"
#include "operators/render/from_fields/field_team.h"
#include "operators/render/from_paths/rendered_series.h"

#include <functional>
#include <string>
#include <vector>

namespace neumann {

// The search stops at the first of these limits that it reaches.
struct FieldGoal {
    std::optional<double>
        relative_error;             // of whole pictures, sampling and discretisation together, for every term that is not all zero
    std::optional<double> seconds;  // for the whole search
    std::optional<FieldSettings> most;  // the settings of the last render, if they are given
};

struct FieldRun {
    FieldPictures pictures;
    FieldSettings settings;                                 // the settings of the pictures
    std::vector<Checkpoint> convergence;                    // one for each render
    std::vector<PictureError> term_errors;                  // the errors of the pictures' terms
    std::vector<DiscretisationReport> discretisation = {};  // for each term, and last for their sum
    Outcome outcome = Outcome::samples_reached;
    double seconds = 0.0;
    std::string why = {};  // why the search ended before the error was reached, in words
};

// The settings of the first render of a search, with the fewest patches, rays and samples.
FieldSettings first_of_search(FieldSettings settings, const FieldSettings& most);

// Renders with growing settings until a limit is reached. A render that is predicted to exceed the time is not started; one that
// exceeds it by a tenth and a second is dropped. Without an error to reach, the search goes on while each step lowers the error by
// a twentieth. If interrupted or out of time, it returns the result of the previous render. Before the first is finished, it
// returns nothing if interrupted, and throws RunError if out of time. It does not call watch.judge.
//
// `team`: the processes that render with this one; null if there are none. `saving`: saves each render but the first. A
// search that starts from a saved render goes on with that one as soon as it has the errors of smaller ones, and
// returns nothing if it is interrupted before that. `see`: called with each result.
std::optional<FieldRun> render_fields_to_goal(const Scene& scene, FieldSettings settings, const FieldGoal& goal, const Watch& watch,
                                              FieldTeam* team = nullptr, FieldSaving* saving = nullptr,
                                              const std::function<void(const FieldRun&)>& see = {});

// A single render with these settings; nothing if it is interrupted.
std::optional<FieldRun> render_fields_once(const Scene& scene, const FieldSettings& settings, const Watch& watch = {},
                                           FieldTeam* team = nullptr, FieldSaving* saving = nullptr);

}  // namespace neumann
