// Chooses patches, directions and samples for an error that is asked for: renders with few, looks at what each part of the error
// comes from, and renders with more of that.
#pragma once

#include "operators/pictures/field_pictures.h"
#include "operators/pictures/render.h"

#include <vector>

namespace neumann {

struct FieldRun {
    FieldPictures pictures;
    FieldSettings settings;                 // that the pictures were made with
    std::vector<Checkpoint> convergence;    // one for each render
    std::vector<PictureError> term_errors;  // of the pictures
    Outcome outcome = Outcome::samples_reached;
    double seconds = 0.0;
};

// Errors of whole pictures, relative: of sampling and of patches together, of every term that is not all zero. Where the largest
// settings do not reach the error that is asked for, or no progress is made, the outcome is samples_reached. Interrupted, it
// returns what the render before reached; the first one is short and is not interrupted. observer.judge is not asked.
FieldRun render_fields_to_error(const Scene& scene, FieldSettings settings, double relative_error, const RenderObserver& observer);

// What the settings of a single render reach; nothing where it is interrupted.
std::optional<FieldRun> render_fields_once(const Scene& scene, const FieldSettings& settings,
                                           const std::function<bool()>& interrupted);

}  // namespace neumann
