#include "operators/render/report/reachable_light.h"

#include "core/emitter/emission_sampler.h"
#include "core/sampling/sampler.h"
#include "core/scene/camera_sample.h"
#include "core/scene/pass_lights.h"
#include "operators/paths/walk/path_group.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// The streams differ from the seeds of the pictures.
constexpr std::uint64_t albedo_stream = 0x616c6265646full, light_stream = 0x6c6967687473ull;
constexpr std::uint64_t rays_of_pixel = 8, points_on_lights = 4096;

}  // namespace

SeenByRays seen_by_rays(const Scene& scene, const std::vector<char>& wanted, std::uint64_t seed) {
    const auto& bsdfs = scene.materials.bsdfs();
    std::vector<Rgb> albedos;
    for (const Bsdf& bsdf : bsdfs) albedos.push_back(largest_albedo(bsdf));
    const Image black(scene.film.crop_width, scene.film.crop_height);
    SeenByRays seen{black, black};
    const double response = scene.camera.largest_response();
    oneapi::tbb::parallel_for(std::size_t{0}, black.pixels.size(), [&](std::size_t number) {
        if (!wanted[number]) return;
        const Pixel pixel = pixel_of(scene.film, static_cast<std::uint32_t>(number));
        Sampler sampler(seed ^ albedo_stream, static_cast<std::uint32_t>(number));
        for (std::uint64_t i = 0; i < rays_of_pixel; ++i) {
            sampler.start(i);
            const CameraRay ray = sample_camera(scene, pixel.x, pixel.y, sampler).ray;
            SurfacePoint x;
            std::uint64_t rays = 0;
            const bool hit = scene.geometry.first_hit(ray.origin, ray.direction, ray.length, x);
            if (!hit) x.shape = SurfacePoint::infinity;
            if (!scene.hide_emitters)
                seen.emitted.pixels[number] =
                    glm::max(seen.emitted.pixels[number], scene.emitters.emitted(x, -ray.direction) * response);
            if (!hit) continue;
            if (scene.hide_emitters && !pass_lights(scene.emitters, scene.geometry, ray.direction, x, rays)) continue;
            const SurfaceSide side = scene.materials.side(x, -ray.direction);
            if (!side.bsdf) continue;
            seen.albedo.pixels[number] =
                glm::max(seen.albedo.pixels[number], albedos[static_cast<std::size_t>(side.bsdf - bsdfs.data())]);
        }
    });
    return seen;
}

Image seen_lights(const Scene& scene, std::uint64_t seed) {
    Image seen(scene.film.crop_width, scene.film.crop_height);
    const EmissionSampler emission(scene.geometry, scene.emitters);
    if (emission.empty() || scene.hide_emitters) return seen;
    const Film& film = scene.film;
    const double radius = neumann::radius(film.filter);
    Sampler sampler(seed ^ light_stream, 0);
    for (std::uint64_t i = 0; i < points_on_lights; ++i) {
        sampler.start(i);
        const Vec2 place = sampler.next2(), direction = sampler.next2(), lens = sampler.next2();
        const SurfacePoint light = emission.sample(place, direction).from;
        if (light.is_infinite()) continue;
        const auto point = scene.camera.see(light.position, lens);
        if (!point || !film.holds(point->position)) continue;
        const Rgb measured = scene.emitters.emitted(light, point->w) * scene.camera.response(point->position);
        if (is_black(measured) || !scene.geometry.visible(light, point->start)) continue;
        if (scene.camera.options().is_even()) {
            for (Rgb& pixel : seen.pixels) pixel = glm::max(pixel, measured);
            continue;
        }
        const int left = std::max(static_cast<int>(std::floor(point->position.x - radius)), film.crop_x),
                  right = std::min(static_cast<int>(std::floor(point->position.x + radius)), film.crop_x + film.crop_width - 1),
                  top = std::max(static_cast<int>(std::floor(point->position.y - radius)), film.crop_y),
                  bottom = std::min(static_cast<int>(std::floor(point->position.y + radius)), film.crop_y + film.crop_height - 1);
        for (int y = top; y <= bottom; ++y)
            for (int x = left; x <= right; ++x) {
                if (film.weight_across(point->position.x, x) * film.weight_down(point->position.y, y) == 0.0) continue;
                Rgb& pixel = seen.at(x - film.crop_x, y - film.crop_y);
                pixel = glm::max(pixel, measured);
            }
    }
    return seen;
}

}  // namespace neumann
