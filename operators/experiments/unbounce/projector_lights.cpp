#include "operators/experiments/unbounce/projector_lights.h"

#include "core/sampling/counter_based.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace neumann {

namespace {

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

// A projector at the place of the camera.
ProjectorLight projector(const Scene& scene, Slide slide) {
    const SensorOptions& camera = scene.camera.options();
    const double away = std::max(glm::distance(Vec3(camera.to_world[3]), scene.geometry.center()), scene.geometry.radius());
    const double half_width = tan_half_width(camera.fov, camera.fov_axis, slide.aspect());
    return {camera.to_world, std::move(slide), away * away, half_width};
}

}  // namespace

ProjectorLights::ProjectorLights(const Scene& scene, int width, int columns, int rows)
    : scene_(on_film(scene, width, columns, rows)),
      columns_(columns),
      rows_(rows),
      white_(projector(scene_, slide_of([](int) { return 1.0; }))),
      numbers_(projector(scene_, slide_of([](int light) { return light + 1.0; }))) {}

std::size_t ProjectorLights::light_at(const Vec3& point) const {
    const Surroundings nothing{};
    const double number = numbers_.beam(point, nothing).irradiance.r / white_.beam(point, nothing).irradiance.r;
    return static_cast<std::size_t>(std::lround(number)) - 1;
}

Scene ProjectorLights::lit_by(std::size_t light) const {
    return lit([light](int other) { return static_cast<std::size_t>(other) == light ? 1.0 : 0.0; });
}
Scene ProjectorLights::flooded() const {
    return lit([](int) { return 1.0; });
}

Scene ProjectorLights::lit(const std::function<double(int light)>& brightness) const {
    Lights lights;
    lights.delta.emplace_back(projector(scene_, slide_of(brightness)));
    return scene_.with(std::move(lights));
}

Slide ProjectorLights::slide_of(const std::function<double(int light)>& brightness) const {
    const auto block = [width = width(), height = height(), columns = columns_, rows = rows_, brightness](const Vec2& uv) {
        const int x = std::min(static_cast<int>(uv.x * width), width - 1),
                  y = std::min(static_cast<int>(uv.y * height), height - 1);
        return Rgb(brightness(block_of_pixel(x, y, width, height, columns, rows)));
    };
    return {block, width(), height(), true};
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
