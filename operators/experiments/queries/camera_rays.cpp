#include "operators/experiments/queries/camera_rays.h"

#include <oneapi/tbb/parallel_for.h>

namespace neumann {

CameraRays camera_rays(const Scene& scene, std::uint64_t first, std::uint64_t count, std::uint64_t seed) {
    const Film& film = scene.film;
    const auto pixels = static_cast<std::uint64_t>(film.crop_width) * static_cast<std::uint64_t>(film.crop_height);
    CameraRays made{std::vector<CameraRay>(count * pixels), std::vector<Pixel>(count * pixels),
                    std::vector<double>(count * pixels)};
    oneapi::tbb::parallel_for(std::uint64_t{0}, count * pixels, [&](std::uint64_t i) {
        const auto number = static_cast<std::uint32_t>(i % pixels);
        Sampler numbers(seed, number);
        numbers.start(first + i / pixels);
        made.pixels[i] = pixel_of(film, number);
        const CameraSample sample = sample_camera(scene, made.pixels[i].x, made.pixels[i].y, numbers);
        made.rays[i] = sample.ray;
        made.weights[i] = sample.weight;
    });
    return made;
}

}  // namespace neumann
