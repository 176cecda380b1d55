// Intervals for bounces that fields have not met. If neither the rays of T nor paths from the lights met anything of a
// bounce, its picture is 0 ± 0, which says nothing: a small lamp in a mirror is seldom met. As with walks
// (least_errors.h), the interval is then
//
//     K^i Le ≤ ‖Le‖∞ a^i,   a the largest albedo,
//
// in pixels where the camera sees a surface that reflects; in bounce 0 it is the light of points on lights that the camera sees. If
// all sides have one cell and no light comes by links, at most 3/n of a side's n rays could have met light (95%), and a bounce
// after one that was met has at most a times the largest pixel of that one, which is a bound even for point lights.
#pragma once

#include "operators/render/report/series_report.h"

namespace neumann {

// Sets `unmet` and the interval of bounces and of a measured rest that are 0, but not known to be.
void report_unmet(SeriesReport& report, const Scene& scene, const FieldPictures& pictures, const FieldSettings& settings);

}  // namespace neumann
