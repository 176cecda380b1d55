// A lower bound on the standard error from the number of rays, however well the replicates agree. All replicates are stratified in
// the same way, so in a symmetric scene all may have the same error. But the mean of n values resolves a jump of the integrand to
// 1/n of its height at best:
//
//     SE ≥ σ/n,   σ the standard deviation of the values that the rays return.
//
// A pixel reads rows of T, and each row has the rays of one facet. The rows are scrambled independently, so for the mean of a
// picture all M rays count: if they all agree, up to 3/M of them could differ (95%), which is about the width of an interval with
// three degrees of freedom.
#pragma once

#include "operators/fields/matrix/traced_series.h"

#include <vector>

namespace neumann {

// The numbers of rays in all replicates together.
struct RayCounts {
    double of_facet = 0.0, all = 0.0;            // rays of T: per facet, and all
    double lights_of_facet = 0.0, lights = 0.0;  // light samples for b: per facet, and all; 0 if b comes from T
    double gathered = 0.0;                       // gather rays of a pixel; 0 if pixels read the field
    double pixels = 0.0;
    std::size_t sampled_at_pixel = 0;  // the first quantities are sampled at the pixel and need no such bound
    bool is_closed = false;            // it is proven that no ray leaves the scene
};

class RayResolution {
public:
    RayResolution() = default;
    // Uses the finer fields. Quantity i + 1 is R T of quantity i; the rest is R T of bounce N plus itself.
    RayResolution(const std::vector<TracedSeries>& replicates, const RayCounts& counts);

    // The least standard error of a quantity, relative to its value: in a pixel, and of the mean over all pixels.
    const Rgb& in_pixel(std::size_t quantity) const { return in_pixel_[quantity]; }
    const Rgb& of_mean(std::size_t quantity) const { return of_mean_[quantity]; }

private:
    std::vector<Rgb> in_pixel_, of_mean_;
};

}  // namespace neumann
