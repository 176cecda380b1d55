#include "operators/fields/matrix/scene_patches.h"

#include "core/base/error.h"
#include "core/emitter/emission_sampler.h"
#include "core/sampling/sampler.h"
#include "core/scene/camera_sample.h"
#include "operators/fields/matrix/sides.h"

#include <fmt/format.h>
#include <algorithm>
#include <limits>

namespace neumann {

namespace {

constexpr std::uint32_t rays = 256;

// Throws InputError unless the side `met` by a ray along w faces a medium of index 1. `what` names the ray's origin in the message.
void check(const Scene& scene, const SurfacePoint& met, const Vec3& w, const std::string& what) {
    if (refractive_index(scene.materials.at(met.shape, glm::dot(met.normal, w) < 0.0)) == 1.0) return;
    const std::string why = what + " stands within glass, which patches do not hold, and walk does";
    if (met.shape >= scene.origins.size()) throw InputError(why);
    throw InputError(scene.origins[met.shape].place, fmt::format("{}: in {}", why, scene.origins[met.shape].shape));
}

bool has_glass(const Scene& scene) {
    const auto& bsdfs = scene.materials.bsdfs();
    return std::any_of(bsdfs.begin(), bsdfs.end(), [](const Bsdf& b) { return refractive_index(&b) > 1.0; });
}

}  // namespace

bool has_glass(const PatchSpace& space) {
    return std::any_of(space.facets().begin(), space.facets().end(), [](const Facet& f) { return f.index > 1.0; });
}

PatchSpace scene_patches(const Scene& scene, const Patching& patching, Glossy glossy) {
    PatchSpace space(scene.geometry, patching, side_directions(scene, glossy));
    if (scene.emitters.empty() || !has_glass(scene)) return space;
    const EmissionSampler lights(scene.geometry, scene.emitters);
    const SobolPoints points(rays);
    Sampler sampler(points, 0, 0);
    for (std::uint32_t i = 0; i < rays && !lights.empty(); ++i) {
        sampler.start(i);
        const Vec2 place = sampler.next2();
        const Emission light = lights.sample(place, sampler.next2());
        SurfacePoint met;
        if (light.from.is_infinite()
                ? scene.geometry.first_hit(light.from.position, light.w, std::numeric_limits<double>::infinity(), met)
                : scene.geometry.first_hit(light.from, light.w, met))
            check(scene, met, light.w, "a light");
    }
    return space;
}

void check_camera(const Scene& scene) {
    if (!has_glass(scene)) return;
    const SobolPoints points(rays);
    Sampler sampler(points, 0, 0);
    for (std::uint32_t i = 0; i < rays; ++i) {
        sampler.start(i);
        const Vec2 u = sampler.next2();
        const Film& film = scene.film;
        const Ray ray =
            sample_camera(scene, film.crop_x + std::min(static_cast<int>(u.x * film.crop_width), film.crop_width - 1),
                          film.crop_y + std::min(static_cast<int>(u.y * film.crop_height), film.crop_height - 1), sampler)
                .ray;
        SurfacePoint met;
        if (scene.geometry.first_hit(ray.origin, ray.direction, ray.length, met)) check(scene, met, ray.direction, "the camera");
    }
}

}  // namespace neumann
