#include "operators/render/from_fields/ray_resolution.h"

namespace neumann {

namespace {

// The relative rounding error: fields and pixels are floats.
constexpr double rounding = 0x1p-22;

// σ/mean of each quantity over all unknowns, weighted by their measure, which is how often rays hit them.
std::vector<Rgb> contrasts(const std::vector<TracedSeries>& replicates) {
    const PatchSpace& space = replicates.front().fine.space();
    const std::size_t quantities = replicates.front().fine.stride() / 3;
    double measure = 0.0;
    std::vector<Rgb> sums(quantities, Rgb(0.0)), squares = sums;
    for (const TracedSeries& series : replicates)
        for (const Facet& facet : space.facets())
            for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u) {
                const double m = space.measure(facet);
                const float* values = series.fine[u];
                measure += m;
                for (std::size_t q = 0; q < quantities; ++q) {
                    const Rgb value(values[3 * q], values[3 * q + 1], values[3 * q + 2]);
                    sums[q] += m * value;
                    squares[q] += m * value * value;
                }
            }
    std::vector<Rgb> result(quantities, Rgb(0.0));
    for (std::size_t q = 0; q < quantities; ++q)
        for (int c = 0; c < 3; ++c) {
            const double mean = sums[q][c] / measure, variance = squares[q][c] / measure - mean * mean;
            if (mean > 0.0 && variance > 0.0) result[q][c] = std::sqrt(variance) / mean;
        }
    return result;
}

}  // namespace

RayResolution::RayResolution(const std::vector<TracedSeries>& replicates, const RayCounts& counts) {
    const std::vector<Rgb> contrast = contrasts(replicates);
    const double open = counts.is_closed ? 0.0 : 1.0 / counts.all;
    Rgb field(0.0);  // relative error of the mean over the field, up to this quantity
    for (std::size_t q = 0; q < contrast.size(); ++q) {
        Rgb in_row(0.0), in_all(0.0);
        const Rgb before = field;
        if (q == 1 && counts.lights > 0.0) {
            in_row = Rgb(1.0 / counts.lights_of_facet);
            in_all = Rgb(1.0 / counts.lights);
        } else if (q > 0) {
            in_row = contrast[q - 1] / counts.of_facet + open;
            in_all = contrast[q - 1] / counts.all + open;
        }
        field += in_all;
        if (q > 1 && counts.gathered > 0.0) {
            in_row = contrast[q - 1] / counts.gathered + open;
            in_all = contrast[q - 1] / (counts.gathered * counts.pixels) + open;
        }
        const bool sampled = q < counts.sampled_at_pixel;
        in_pixel_.push_back(sampled ? Rgb(0.0) : before + in_row + rounding);
        of_mean_.push_back(sampled ? Rgb(0.0) : before + in_all + rounding);
    }
}

}  // namespace neumann
