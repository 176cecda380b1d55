// A path of our own through a pixel: what to look at where another renderer's picture differs.
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
    Vec3 position{0.0};       // of a vertex at infinity, one in its direction
    // In pixels from the picture's upper left corner, where the camera has the vertex between its planes. It may be outside the
    // picture, or hidden.
    std::optional<Vec2> film;
};

struct OurPath {
    std::uint64_t sample = 0;  // of the pixel
    Vec3 camera{0.0};          // where it begins
    std::vector<PathVertex> vertices;
    bool is_blocked = false;  // something is between the last two: no light comes from there
    int bounce = 0;           // that it brings light to, or may have
    Rgb value{0.0};           // what it brings to the pixel in the bounces in question, radiance
};

// The path that brings most to one of these bounces, among the first samples of a pixel; if none of them brings any, the first one
// as far as it comes, with the light that it asks for behind something. `pixel`: its number, row by row.
OurPath brightest_path(const Scene& scene, const RecordedSamples& render, std::uint32_t pixel, std::uint64_t samples,
                       const BounceRange& bounces);

}  // namespace neumann
