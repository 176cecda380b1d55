// The bidirectional strategies (s, t) for one bounce, s vertices from the light and t from the camera: each one's contribution with
// its MIS weight, and its estimate without the weight.
#pragma once

#include "operators/render/from_paths/rendered_series.h"
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

// `settings` must be those of the bidirectional method; its samples and seed are used.
Ways render_ways(const Scene& scene, SamplingSettings settings, int bounce, std::uint64_t samples, const Watch& watch);

}  // namespace neumann
