// tr(x, ω), V(x, y) and samples of light for many points at once, on all processors: what an estimator from outside asks of a
// scene.
#pragma once

#include "core/emitter/light_sampler.h"
#include "core/scene/scene.h"

#include <limits>
#include <span>
#include <vector>

namespace neumann {

// What a ray from x along ω sees: y = tr(x, ω).
struct SeenPoint {
    SurfacePoint y;                                             // at infinity if nothing is seen
    double distance = std::numeric_limits<double>::infinity();  // scene units
    Vec3 normal{std::numeric_limits<double>::quiet_NaN()};      // unit length, as the material has it, on the side that is seen
    Rgb emission{0.0};                                          // Le(y, −ω)
    Rgb reflectance{std::numeric_limits<double>::quiet_NaN()};  // π fs of that side: 0 if it absorbs, NaN if it is not diffuse
};

// From points in space, up to the length of each ray, or from surfaces. Directions have unit length.
std::vector<SeenPoint> see(const Scene& scene, std::span<const Ray> rays);
std::vector<SeenPoint> see(const Scene& scene, std::span<const SurfacePoint> from, std::span<const Vec3> directions);

// The same of rays of the camera, which see neither lights nor surroundings where the scene hides them (Scene::hide_emitters).
std::vector<SeenPoint> see_from_camera(const Scene& scene, std::span<const Ray> rays);

// V(x, y) of each pair. A point in space is at infinity and has no normal, but a position.
std::vector<char> visible(const Scene& scene, std::span<const SurfacePoint> x, std::span<const SurfacePoint> y);

// A sample of light as next-event estimation has it by default: a point on a surface is chosen by area, whatever x is.
struct LightPoint : LightSample {
    double density = std::numeric_limits<double>::quiet_NaN();  // of the point, per area; NaN if it is not on a surface
};

// One for each of the points x.
std::vector<LightPoint> sample_lights(const Scene& scene, std::span<const SurfacePoint> x, std::span<const Vec2> u);

}  // namespace neumann
