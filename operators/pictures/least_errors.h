// What few samples leave open however well they agree. A sliver of light that no sample of a pixel met is no zero, and replicates
// that agree by chance are no proof: the error of a pixel is not below
//
//     h/t,  h = 3 D/n      where all replicates agree, and so where no sample met anything: the rule of three, as p, the chance of
//                          a sample that differs, is below 3/n with 95% confidence: (1 − p)^n ≤ e^{−pn} = 0.05
//           h = D/n        elsewhere: one sample more or less. Replicates of stratified samples that should meet something a
//                          little more often often meet it equally often, and do not show that
//
// with n samples a pixel, t of the 95% interval, and D the largest less the smallest sample of the pixel and its eight neighbours.
// Where these are all 0 and something may be there, D is the largest sample of the picture's bounce, or of those before it, or
// where there is none ‖Le‖∞ a^i; and h is at most ‖K^i Le‖∞ ≤ ‖Le‖∞ a^i, a the largest albedo. What is known to be empty has no
// such error: channels without light or albedo, bounces of which the plan says so, and pixels around which no ray meets what
// reflects.
#pragma once

#include "operators/pictures/rendered_series.h"
#include "operators/pictures/series_report.h"

#include <vector>

namespace neumann {

class LeastErrors {
public:
    LeastErrors(const Scene& scene, const SamplingSettings& settings, const RenderedSeries& series,
                const SeriesMoments::Result& result);

    // Of quantity i, and of the sum of the quantities 0 … i, whose terms' errors are added in squares; empty where there are none.
    Image of_term(std::size_t i) const { return image(terms_, i); }
    Image of_sum(std::size_t i) const { return image(sums_, i); }

    // An upper bound, with 95% confidence, on the mean of quantity i over pixels and channels where no sample of the picture met
    // it: 0 where some did, or where nothing is there; infinite where there is no bound.
    double mean_at_most(std::size_t i) const { return means_at_most_[i]; }

private:
    using Errors = std::vector<float>;  // pixel by pixel, three channels each; empty: all 0
    Image image(const std::vector<Errors>& all, std::size_t i) const;

    int width_, height_;
    std::vector<Errors> terms_, sums_;
    std::vector<double> means_at_most_;
};

// Bounces that no sample met, and the rest, have these bounds as intervals.
void report_unmet(SeriesReport& report, const LeastErrors& least);

}  // namespace neumann
