// Estimates the light that a method misses because it cannot make all paths.
#pragma once

#include "operators/render/from_paths/pilot.h"
#include "operators/render/report/series_report.h"

namespace neumann {

// Sets the missing light of bounces up to Pilot::bounces(): mean(pilot) − mean(picture), which are independent.
void report_missing(SeriesReport& report, const Pilot& pilot);

}  // namespace neumann
