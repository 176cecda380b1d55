// A group of paths that advance together: those of consecutive pixels in one replicate, in order.
#pragma once

#include "core/scene/camera_sample.h"
#include "operators/paths/walk/term_samples.h"
#include "operators/paths/walk/walker.h"
#include "operators/statistics/sample_place.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace neumann {

// The number is large enough that the paths still alive fill the ray packets.
constexpr std::uint32_t paths_at_once = 64;

struct Pixel {
    int x, y;
};
inline Pixel pixel_of(const Film& film, std::uint32_t number) {
    const auto width = static_cast<std::uint32_t>(film.crop_width);
    return {film.crop_x + static_cast<int>(number % width), film.crop_y + static_cast<int>(number / width)};
}
// The inverse of pixel_of(); nothing if the pixel is outside of the film's crop.
inline std::optional<std::uint32_t> number_of(const Film& film, const Pixel& pixel) {
    const int column = pixel.x - film.crop_x, row = pixel.y - film.crop_y;
    if (column < 0 || row < 0 || column >= film.crop_width || row >= film.crop_height) return std::nullopt;
    return static_cast<std::uint32_t>(row * film.crop_width + column);
}

struct PathGroup {
    std::vector<CameraRay> rays;
    std::vector<double> weights;  // weights of the film's filter
    Walkers walkers;
    std::vector<Rgb> samples;  // path by path, with all quantities of a path together
};

// Samples one replicate of some pixels, with a sampler for each of their samples, and calls estimate(rays, samplers,
// walkers, result). Adds the number of rays cast for each quantity to `rays`. Returns the number of walks given up.
template <class Estimate, class Sampler>
std::uint64_t trace(const Scene& scene, const Estimate& estimate, std::span<Sampler> samplers, std::span<const Pixel> pixels,
                    std::uint64_t replicate, PathGroup& group, std::span<std::uint64_t> rays) {
    const std::size_t size = samplers.size() / pixels.size(), quantities = rays.size();
    group.rays.resize(samplers.size());
    group.weights.resize(samplers.size());
    for (std::size_t i = 0; i < samplers.size(); ++i) {
        const Pixel& pixel = pixels[i / size];
        samplers[i].start(replicate * size + i % size);
        const CameraSample sample = sample_camera(scene, pixel.x, pixel.y, samplers[i]);
        group.rays[i] = sample.ray;
        group.weights[i] = sample.weight;
    }
    group.samples.assign(samplers.size() * quantities, Rgb(0.0));
    TermSamples result{group.samples, rays};
    estimate(std::span<const CameraRay>(group.rays), samplers, group.walkers, result);
    for (std::size_t i = 0; i < samplers.size(); ++i) {
        if (group.weights[i] == 1.0) continue;
        for (Rgb& x : std::span(group.samples).subspan(i * quantities, quantities)) x *= group.weights[i];
    }
    return result.given_up;
}

}  // namespace neumann
