// The ways (s, t) to make one bounce, s vertices from the light and t from the camera: what each brings to the picture with its
// weight, and what it would make by itself.
#pragma once

#include "apps/files/output_folder.h"
#include "operators/pictures/render.h"
#include "operators/statistics/picture_statistics.h"

#include <nlohmann/json.hpp>

#include <string>
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

// The same samples and seed as `settings`, of `method` bidirectional.
Ways render_ways(const Scene& scene, SamplingSettings settings, int bounce, std::uint64_t samples, const RenderObserver& observer);

// way_s1_t3.exr …, way_s1_t3_unweighted.exr …, and ways.png with all of them.
void write_ways(OutputFolder& folder, const Ways& ways);
std::string ways_table(const Ways& ways);
nlohmann::ordered_json as_json(const Ways& ways);

}  // namespace neumann
