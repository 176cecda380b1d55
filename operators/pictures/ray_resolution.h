// How sure a picture can be by the number of its rays, however well its replicates agree. All are stratified alike, so that in a
// symmetric scene each of them may count the same, and be wrong by as much. But no mean of n values tells a jump of what it
// averages better than to 1/n of it:
//
//     SE ≥ σ/n,   σ the standard deviation of what rays bring.
//
// A pixel reads rows of T, each of the rays of one facet. The rows are scrambled each by itself, so that in the mean of a picture
// all M rays count: where they agree, a share of 3/M of them may be otherwise (95%), and the interval of three degrees of freedom
// is as wide.
#pragma once

#include "operators/matrix/traced_series.h"

#include <vector>

namespace neumann {

// Rays of all replicates together.
struct RayCounts {
    double of_facet = 0.0, all = 0.0;            // of T
    double lights_of_facet = 0.0, lights = 0.0;  // for b; 0 where T makes it
    double gathered = 0.0;                       // at a pixel that applies K once more; 0 where it reads the field
    double pixels = 0.0;
    std::size_t sampled_at_pixel = 0;  // quantities that tell their own error
    bool is_closed = false;            // proven: no ray can leave. Otherwise one may have
};

class RayResolution {
public:
    RayResolution() = default;
    // `replicates`: their finer fields, of which quantity i + 1 is R T of quantity i, the rest that of bounce N and itself.
    RayResolution(const std::vector<TracedSeries>& replicates, const RayCounts& counts);

    // The least standard error of a quantity, relative to its value: in a pixel, and of the mean over all pixels.
    const Rgb& in_pixel(std::size_t quantity) const { return in_pixel_[quantity]; }
    const Rgb& of_mean(std::size_t quantity) const { return of_mean_[quantity]; }

private:
    std::vector<Rgb> in_pixel_, of_mean_;
};

}  // namespace neumann
