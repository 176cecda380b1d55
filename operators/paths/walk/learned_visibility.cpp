#include "operators/paths/walk/learned_visibility.h"

#include "core/emitter/light_sampler.h"
#include "core/sampling/sampler.h"
#include "operators/paths/walk/vertices_of_walks.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace neumann {

namespace {

constexpr std::uint32_t walks_of_pixel = 16;
constexpr int deepest = 4;                            // reflections; later vertices are where these are
constexpr std::size_t most_lights = 32;               // asked from a vertex
constexpr int cells_along = 24;                       // cubes along the scene
constexpr std::uint64_t seen_stream = 0x7365656eull;  // differs from the seed of the pictures

}  // namespace

std::shared_ptr<const LightVisibility> learn_visibility(const Scene& scene, int bounces, const Watch& watch) {
    const LightSampler lights(scene.geometry, scene.emitters, LightChoice::all);
    if (lights.empty()) return nullptr;
    const std::size_t all_lights = lights.samples_per_point(), asked = std::min(all_lights, most_lights);
    const auto vertices = vertices_of_walks(scene, std::min(bounces, deepest), walks_of_pixel, seen_stream, watch);
    std::vector<std::vector<LightVisibility::Ray>> of_pixels(vertices.size());
    oneapi::tbb::parallel_for(std::size_t{0}, vertices.size(), [&](std::size_t pixel) {
        if (watch.stop()) return;
        Sampler sampler(seen_stream + 1, static_cast<std::uint32_t>(pixel));
        sampler.start(0);
        for (const WalkVertex& v : vertices[pixel]) {
            const auto first = static_cast<std::size_t>(sampler.next() * static_cast<double>(all_lights));
            for (std::size_t k = 0; k < asked; ++k) {
                const LightSample light =
                    lights.sample(v.x.position, sampler.next2(), (first + k * all_lights / asked) % all_lights);
                if (!(light.pdf > 0.0) || !(glm::dot(light.w, v.normal) > 0.0)) continue;
                const std::size_t number =
                    light.point.is_infinite() ? scene.geometry.shapes().size() + light.distant : light.point.shape;
                of_pixels[pixel].push_back({v.x.position, v.normal, number, scene.geometry.visible(v.x, light.point)});
            }
        }
    });
    if (watch.stop()) throw Stopped();
    std::vector<LightVisibility::Ray> all;
    std::vector<Vec3> places;
    for (const auto& some : of_pixels)
        for (const LightVisibility::Ray& ray : some) {
            all.push_back(ray);
            places.push_back(ray.x);
        }
    return std::make_shared<const LightVisibility>(PlaceCells(places, cells_along), scene.emitters.powers().size(), all);
}

}  // namespace neumann
