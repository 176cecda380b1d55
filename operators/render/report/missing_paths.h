// How much light is missing of a method that cannot make all paths.
#pragma once

#include "operators/render/from_paths/pilot.h"
#include "operators/render/report/series_report.h"

namespace neumann {

// Sets what is missing of each bounce: mean(pilot) − mean(picture), which are independent, for bounces up to Pilot::bounces().
void report_missing(SeriesReport& report, const Pilot& pilot);

}  // namespace neumann
