// A path of our own through a pixel in which another renderer's picture differs.
#pragma once

#include "core/scene/scene.h"
#include "operators/experiments/blame/other_pictures.h"
#include "operators/render/methods/recorded_render.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace neumann {

struct PathVertex {
    std::uint32_t shape = 0;  // or SurfacePoint::infinity
    Vec3 position{0.0};       // for a vertex at infinity, a point in its direction
    // In pixels from the picture's upper left corner, if the vertex is between the camera's clipping planes. It may be
    // outside the picture, or hidden.
    std::optional<Vec2> film;
};

struct OurPath {
    std::uint64_t sample = 0;  // number of the sample in the pixel
    Vec3 camera{0.0};          // where the path begins
    std::vector<PathVertex> vertices;
    bool is_blocked = false;  // something lies between the last two vertices: no light comes from the last
    int bounce = 0;           // the bounce to which it brings light, or would if it were not blocked
    Rgb value{0.0};           // its contribution to the pixel in the given bounces, radiance
};

// The path with the largest contribution to one of these bounces, among the first samples of a pixel. If none
// contributes, the first one as far as it goes, ending with a blocked light sample. `pixel`: its number, row by row.
OurPath brightest_path(const Scene& scene, const RecordedSamples& render, std::uint32_t pixel, std::uint64_t samples,
                       const BounceRange& bounces);

}  // namespace neumann
