#include "operators/paths/walk/vertices_of_walks.h"

#include "core/sampling/sampler.h"
#include "core/scene/camera_sample.h"
#include "operators/paths/walk/path_group.h"
#include "operators/paths/walk/tree_walk.h"

#include <oneapi/tbb/parallel_for.h>

namespace neumann {

namespace {

struct Vertices : NoObserver {
    Vertices(std::vector<WalkVertex>& found, std::size_t walks) : found(found), w(walks) {}
    void casts(std::uint32_t walk, bool, int, const PathEnd& from) const { w[walk] = from.w; }
    void meets(std::uint32_t walk, const SurfacePoint& x) const {
        if (!x.is_infinite()) found.push_back({x, glm::dot(x.normal, w[walk]) < 0.0 ? x.normal : -x.normal});
    }
    std::vector<WalkVertex>& found;
    mutable std::vector<Vec3> w;  // directions of the rays under way
};

}  // namespace

std::vector<std::vector<WalkVertex>> vertices_of_walks(const Scene& scene, int reflections, std::uint32_t walks_of_pixel,
                                                       std::uint64_t seed, const Watch& watch) {
    // Directions of the material alone: no light is asked on the way.
    const WalkSettings settings{.bounces = reflections, .direct = {.direct = DirectLight::bsdf}, .rest_probability = 0.0};
    const DirectLightSampler direct(scene, settings.direct);
    const std::size_t quantities = static_cast<std::size_t>(reflections) + 2;
    const auto pixels = static_cast<std::uint32_t>(scene.film.crop_width * scene.film.crop_height);
    std::vector<std::vector<WalkVertex>> found(pixels);
    oneapi::tbb::parallel_for(std::uint32_t{0}, pixels, [&](std::uint32_t number) {
        if (watch.stop()) return;
        const Pixel pixel = pixel_of(scene.film, number);
        std::vector<Sampler> samplers(walks_of_pixel, Sampler(seed, number));
        std::vector<CameraRay> camera;
        for (std::uint32_t i = 0; i < walks_of_pixel; ++i) {
            samplers[i].start(i);
            camera.push_back(sample_camera(scene, pixel.x, pixel.y, samplers[i]).ray);
        }
        std::vector<std::uint64_t> rays(quantities);
        std::vector<Rgb> unused(walks_of_pixel * quantities);
        TermSamples out{unused, rays};
        TreeWalkers walkers;
        walk_tree(scene, direct, settings, {}, std::span<const CameraRay>(camera), std::span(samplers), walkers, out,
                  Vertices(found[number], walks_of_pixel));
    });
    if (watch.stop()) throw Stopped();
    return found;
}

}  // namespace neumann
