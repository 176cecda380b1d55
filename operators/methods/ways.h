// The ways (s, t) to make one bounce, s vertices from the light and t from the camera: what each brings to the picture with its
// weight, and what it would make by itself.
#pragma once

#include "operators/pictures/rendered_series.h"
#include "operators/statistics/picture_statistics.h"

#include <vector>

namespace neumann {

struct WayPicture {
    Estimate picture;
    PictureMeans means;
    bool infinite_variance = false;
};
struct Way {
    int s = 0, t = 0;
    WayPicture weighted, unweighted;
};
struct Ways {
    int bounce = 0;
    std::vector<Way> ways;
};

// The same samples and seed as `settings`, of the bidirectional method.
Ways render_ways(const Scene& scene, SamplingSettings settings, int bounce, std::uint64_t samples, const Watch& watch);

}  // namespace neumann
