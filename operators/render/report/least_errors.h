// Lower bounds on standard errors. A pixel may miss a sliver of light that none of its samples met, and replicates may agree by
// chance, so the standard error of a pixel is at least h/t, where t belongs to the 95% interval and h is the larger of
//
//     what one sample more or less leaves open (one_sample_more.h); not in bounces from 2 on by photons and records, whose
//     samples are means of many, unless replicates agree
//     what few events leave open (few_events.h), if no sample is negative: a path that brings much is an event, and so is
//     a chain's stay
//
// D is the largest minus the smallest sample of the pixel and its eight neighbours. If these are all 0 but light may be
// there, D is the largest sample of this bounce in the picture; failing that, of an earlier bounce, or ‖Le‖∞ a^i, where
// a is the largest albedo, and more for paths that survive roulette. There is no bound at all for a path of `light` or
// a photon, and for a point on a light whose weight directions do not share, if no earlier bounce but Le has met
// anything. h ≤ ‖K^i Le‖∞ ≤ ‖Le‖∞ a^i. The bound is 0 where it is known that nothing is there: channels without light
// or albedo, bounces that the plan proves empty, and pixels around which no ray meets a reflecting surface.
#pragma once

#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/report/series_report.h"

#include <vector>

namespace neumann {

class LeastErrors {
public:
    LeastErrors(const Scene& scene, const SamplingSettings& settings, const RenderedSeries& series,
                const SeriesMoments::Result& result);

    // The bounds for quantity i, and for the sum of quantities 0 … i (added in squares). The image is empty if all are 0.
    Image of_term(std::size_t i) const { return image(terms_, i); }
    Image of_sum(std::size_t i) const { return image(sums_, i); }

    // If no sample of the whole picture met quantity i: an upper bound, with 95% confidence, on its mean over pixels and channels;
    // infinite if there is no bound. Otherwise, or if nothing is there: 0.
    double mean_at_most(std::size_t i) const { return means_at_most_[i]; }
    // The least standard error of the mean over pixels and channels, by one sample more or less; 0 if pixels share samples.
    double of_mean(std::size_t i) const { return of_means_[i]; }

private:
    using Errors = std::vector<float>;  // pixel by pixel, three channels each; empty: all 0
    Image image(const std::vector<Errors>& all, std::size_t i) const;

    int width_, height_;
    std::vector<Errors> terms_, sums_;
    std::vector<double> means_at_most_, of_means_;
};

// Sets mean_at_most() as the interval of bounces, or of the rest, that no sample met, and of_mean() as the least error of others.
void report_least(SeriesReport& report, const LeastErrors& least);

}  // namespace neumann
