#include "operators/render/report/missing_paths.h"

#include <algorithm>

namespace neumann {

void report_missing(SeriesReport& report, const Pilot& pilot) {
    const std::size_t known = std::min(report.bounces.size(), static_cast<std::size_t>(pilot.bounces()) + 1);
    for (std::size_t i = 0; i < known; ++i)
        report.bounces[i].missing = difference(pilot.term(static_cast<int>(i)), report.bounces[i].mean);
}

}  // namespace neumann
