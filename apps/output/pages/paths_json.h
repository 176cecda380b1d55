// The paths of pixels for the page: their rays on the film and from above, contributions, and the pixels' histories.
#pragma once

#include "apps/output/files/recorded_run.h"
#include "apps/requests/chosen_pixels.h"

#include <nlohmann/json.hpp>

namespace neumann {

// "outline" (of the scene, from above), "above" (the axis), "pixels": each with "pixel", "picture" (its place in the picture),
// "count" (samples), "method", "history" or "why_no_history", and "paths". Throws InputError for a pixel outside the picture.
nlohmann::ordered_json paths_json(const RecordedRun& run, const Scene& scene, const ChosenPixels& chosen);

}  // namespace neumann
