// Methods that make some of all paths only, and how much light they leave out.
#pragma once

#include "operators/pictures/pilot.h"
#include "operators/pictures/series_report.h"

namespace neumann {

// Which paths a method makes, where these are not all.
enum class Paths {
    all,
    without_specular,  // none by way of a mirror, glass or another delta
    seen_directly,     // those that the camera sees on surfaces, and not by way of a delta
    specular           // those whose reflections are specular but for the last one, which looks for light
};
// Some material sends light in a single direction.
bool has_specular(const Materials& materials);
Paths paths_of(PathMethod method, const Scene& scene);

// What is missing of each bounce: mean(pilot) − mean(picture), whose walks are independent, for as many bounces as the pilot knows.
void report_missing(SeriesReport& report, const Pilot& pilot);

}  // namespace neumann
