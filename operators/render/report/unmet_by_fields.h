// What fields have not met. Where neither the rays of T nor paths from the lights met anything of a bounce, its picture is 0 ± 0,
// which says nothing: a small lamp in a mirror is met seldom. As with walks (least_errors.h),
//
//     K^i Le ≤ ‖Le‖∞ a^i,   a the largest albedo,
//
// is then its interval, in pixels where the camera sees a surface that reflects; in bounce 0, what it sees of points on lights. If
// all sides have one cell and no light comes by links, then up to 3/n of a side's n rays could have met that (95%), and a bounce
// after one that was met has at most a times the largest pixel of that, which is a bound where point lights have none.
#pragma once

#include "operators/render/report/series_report.h"

namespace neumann {

// Sets `unmet` and the interval of bounces and of a measured rest that are 0, but not known to be.
void report_unmet(SeriesReport& report, const Scene& scene, const FieldPictures& pictures, const FieldSettings& settings);

}  // namespace neumann
