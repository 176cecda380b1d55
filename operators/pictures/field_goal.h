// Chooses patches, directions and samples for an error that is asked for, or for the time that there is: renders with few, looks at
// what each part of the error comes from, and renders with more of that. Before each render it predicts what that takes and what it
// brings, and ends where it does not fit or does not pay.
#pragma once

#include "operators/pictures/field_pictures.h"
#include "operators/pictures/rendered_series.h"

#include <string>
#include <vector>

namespace neumann {

// When to stop; whichever comes first.
struct FieldGoal {
    std::optional<double>
        relative_error;             // of whole pictures: of sampling and of patches together, of every term that is not all zero
    std::optional<double> seconds;  // of everything; the first pictures, with the fewest patches, are finished in any case
    std::optional<FieldSettings> most;  // the settings to end with, where these are given
};

struct FieldRun {
    FieldPictures pictures;
    FieldSettings settings;                 // that the pictures were made with
    std::vector<Checkpoint> convergence;    // one for each render
    std::vector<PictureError> term_errors;  // of the pictures
    Outcome outcome = Outcome::samples_reached;
    double seconds = 0.0;
    std::string why = {};  // it ended, in words, where the error asked for was not reached
};

// No render is begun that would go on beyond the time, as far as it can be foretold; one that does is given up a tenth and a second
// later. Without an error to reach, it goes on while that falls by a twentieth a step. Interrupted or out of time, it returns what
// the render before reached; the first one is not stopped. watch.judge is not asked.
FieldRun render_fields_to_goal(const Scene& scene, FieldSettings settings, const FieldGoal& goal, const Watch& watch);

// What the settings of a single render reach; nothing where it is interrupted.
std::optional<FieldRun> render_fields_once(const Scene& scene, const FieldSettings& settings, const std::function<bool()>& stop);

}  // namespace neumann
