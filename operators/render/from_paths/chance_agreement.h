// Corrects the errors of pixels whose samples differ although their replicates agree: their spread is zero by chance
// (operators/statistics/one_sample_more.h), and a goal must not stop there.
#pragma once

#include "operators/statistics/one_sample_more.h"
#include "operators/statistics/picture_statistics.h"
#include "operators/statistics/student_t.h"

#include <cmath>
#include <utility>

namespace neumann {

// Returns the term with larger errors in such pixels. `ranges`: the ranges of the samples, for all quantities of a
// pixel, `quantity` being one of them; nothing is changed if they are unknown. `samples`: per pixel.
inline Estimate without_chance_agreement(Estimate term, const SampleRanges& ranges, std::size_t quantity, double samples) {
    const std::size_t pixels = term.mean.pixels.size(), stride = ranges.of.size() / pixels;
    const double t = student_t_quantile(0.95, term.degrees_of_freedom);
    if (stride == 0 || !std::isfinite(t)) return term;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        for (int c = 0; c < 3; ++c) {
            double& error = term.standard_error.pixels[pixel][c];
            if (error <= agreement * std::abs(term.mean.pixels[pixel][c]))
                error = std::max(error, least_half_width(difference(ranges.of[pixel * stride + quantity], c), samples, true) / t);
        }
    return term;
}

}  // namespace neumann
