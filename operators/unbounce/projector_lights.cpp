#include "operators/unbounce/projector_lights.h"

#include "core/emitter/projector_light.h"
#include "core/sampling/counter_based.h"
#include "operators/unbounce/regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

constexpr int all_lights = -1;

Scene on_film(const Scene& scene, int width, int columns, int rows) {
    const SensorOptions& camera = scene.camera.options();
    if (camera.kind != SensorOptions::Kind::perspective || camera.principal_point_offset != Vec2(0.0))
        throw InputError("a projector takes the place of the camera: expected a perspective sensor without principal_point_offset");
    const Film& whole = scene.film;
    if (whole.crop_width != whole.width || whole.crop_height != whole.height)
        throw InputError("the film is cropped, expected a whole one");
    Film film;
    film.width = film.crop_width = width;
    film.height = film.crop_height =
        std::max(1, static_cast<int>(std::lround(static_cast<double>(width) * whole.height / whole.width)));
    film.filter = BoxFilter();
    if (columns > film.width || rows > film.height)
        throw InputError(fmt::format("{}×{} lights for pictures of {}×{} pixels, expected at most one a pixel", columns, rows,
                                     film.width, film.height));
    return scene.with(film);
}

}  // namespace

ProjectorLights::ProjectorLights(const Scene& scene, int width, int columns, int rows)
    : scene_(on_film(scene, width, columns, rows)), columns_(columns), rows_(rows) {}

Scene ProjectorLights::lit_by(std::size_t light) const { return lit(static_cast<int>(light)); }
Scene ProjectorLights::flooded() const { return lit(all_lights); }

Scene ProjectorLights::lit(int light) const {
    const int width = scene_.film.width, height = scene_.film.height;
    const auto block = [width, height, columns = columns_, rows = rows_, light](const Vec2& uv) {
        const int x = std::min(static_cast<int>(uv.x * width), width - 1),
                  y = std::min(static_cast<int>(uv.y * height), height - 1);
        return Rgb(light == all_lights || block_of_pixel(x, y, width, height, columns, rows) == light ? 1.0 : 0.0);
    };
    const SensorOptions& camera = scene_.camera.options();
    const double aspect = static_cast<double>(width) / height;
    const double away = std::max(glm::distance(Vec3(camera.to_world[3]), scene_.geometry.center()), scene_.geometry.radius());
    Lights lights;
    lights.delta.emplace_back(ProjectorLight(camera.to_world, Slide(block, width, height, true), away * away,
                                             tan_half_width(camera.fov, camera.fov_axis, aspect)));
    return scene_.with(std::move(lights));
}

Goal ProjectorLights::goal_of(std::size_t light, std::uint64_t samples, std::uint64_t seed) {
    const auto bits = CounterBased(seed, 0)(light, 0);
    Goal goal;
    goal.bounces = 1;
    goal.samples = samples;
    goal.seed = std::uint64_t{bits[0]} << 32 | bits[1];
    return goal;
}

}  // namespace neumann
