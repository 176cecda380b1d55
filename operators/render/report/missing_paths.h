// Which paths a method cannot make, and how much light is missing.
#pragma once

#include "operators/render/from_paths/pilot.h"
#include "operators/render/report/series_report.h"

namespace neumann {

// The set of paths that a method makes.
enum class Paths {
    all,
    without_specular,  // no reflection by a delta lobe (mirror, glass)
    seen_directly,     // the vertex that the camera sees is on a surface and does not scatter by a delta lobe
    specular           // all reflections are by delta lobes, except the last one, which samples the lights
};
// Whether some material has a delta lobe.
bool has_specular(const Materials& materials);
Paths paths_of(PathGenerator generator, const Scene& scene);

// Sets what is missing of each bounce: mean(pilot) − mean(picture), which are independent, for bounces up to Pilot::bounces().
void report_missing(SeriesReport& report, const Pilot& pilot);

}  // namespace neumann
