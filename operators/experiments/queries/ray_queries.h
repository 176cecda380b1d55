// tr(x, ω), V(x, y) and light samples for many points at once, on all processors, for estimators outside the program.
#pragma once

#include "core/emitter/light_sampler.h"
#include "core/scene/scene.h"

#include <limits>
#include <span>
#include <vector>

namespace neumann {

// The result of a ray from x along ω: y = tr(x, ω).
struct SeenPoint {
    SurfacePoint y;                                             // at infinity if nothing is seen
    double distance = std::numeric_limits<double>::infinity();  // scene units
    // Unit length, as the material uses it, on the side that is seen.
    Vec3 normal{std::numeric_limits<double>::quiet_NaN()};
    Rgb emission{0.0};                                          // Le(y, −ω)
    Rgb reflectance{std::numeric_limits<double>::quiet_NaN()};  // π fs of that side: 0 if it absorbs, NaN if it is not diffuse
};

// Rays from points in space, up to the length of each ray, or from surfaces. Directions have unit length.
std::vector<SeenPoint> see(const Scene& scene, std::span<const Ray> rays);
std::vector<SeenPoint> see(const Scene& scene, std::span<const SurfacePoint> from, std::span<const Vec3> directions);

// The same for rays of the camera, which do not see lights and surroundings if the scene hides them (hide_emitters).
std::vector<SeenPoint> see_from_camera(const Scene& scene, std::span<const Ray> rays);

// V(x, y) of each pair. A point in space is given at infinity, without a normal but with its position.
std::vector<char> visible(const Scene& scene, std::span<const SurfacePoint> x, std::span<const SurfacePoint> y);

// A light sample as next-event estimation makes it by default: a point on a surface is chosen by area, whatever x is.
struct LightPoint : LightSample {
    double density = std::numeric_limits<double>::quiet_NaN();  // of the point, per area; NaN if it is not on a surface
};

// One light sample for each of the points x.
std::vector<LightPoint> sample_lights(const Scene& scene, std::span<const SurfacePoint> x, std::span<const Vec2> u);

}  // namespace neumann
