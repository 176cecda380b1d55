#include "operators/experiments/queries/ray_queries.h"

#include "core/scene/pass_lights.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

constexpr std::size_t at_once = RayCaster::packet_size;

// Calls f(first, number) for packets of rays.
template <class F>
void for_packets(std::size_t n, const F& f) {
    constexpr std::size_t packets_of_a_task = 64;
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<std::size_t>(0, (n + at_once - 1) / at_once, packets_of_a_task), [&](const auto& range) {
            for (std::size_t first = range.begin() * at_once; first < std::min(n, range.end() * at_once); first += at_once)
                f(first, std::min(at_once, n - first));
        });
}

Rgb reflectance_of(const SurfaceSide& side) {
    if (!side.bsdf) return Rgb(0.0);
    const auto* diffuse = std::get_if<Diffuse>(side.bsdf);
    return diffuse ? diffuse->reflectance(side.p) : Rgb(std::numeric_limits<double>::quiet_NaN());
}

void describe(const Scene& scene, const Vec3& origin, const Vec3& direction, bool is_found, SeenPoint& seen) {
    if (is_found) {
        const SurfaceSide side = scene.materials.side(seen.y, -direction);
        seen.distance = glm::dot(seen.y.position - origin, direction);
        seen.normal = side.p.frame.n;
        seen.reflectance = reflectance_of(side);
    } else {
        seen.y.position = Vec3(std::numeric_limits<double>::quiet_NaN());
        seen.y.shape = SurfacePoint::infinity;
    }
    seen.emission = scene.emitters.emitted(seen.y, -direction);
}

}  // namespace

std::vector<SeenPoint> see(const Scene& scene, std::span<const Ray> rays) {
    std::vector<SeenPoint> seen(rays.size());
    for_packets(rays.size(), [&](std::size_t first, std::size_t n) {
        const std::uint32_t found =
            scene.geometry.first_hits(rays.subspan(first, n), [&](std::size_t i) -> SurfacePoint& { return seen[first + i].y; });
        for (std::size_t i = 0; i < n; ++i)
            describe(scene, rays[first + i].origin, rays[first + i].direction, (found >> i & 1u) != 0, seen[first + i]);
    });
    return seen;
}

std::vector<SeenPoint> see(const Scene& scene, std::span<const SurfacePoint> from, std::span<const Vec3> directions) {
    std::vector<SeenPoint> seen(from.size());
    for_packets(from.size(), [&](std::size_t first, std::size_t n) {
        const std::uint32_t found = scene.geometry.first_hits(
            n, [&](std::size_t i) { return std::pair<const SurfacePoint&, const Vec3&>(from[first + i], directions[first + i]); },
            [&](std::size_t i) -> SurfacePoint& { return seen[first + i].y; });
        for (std::size_t i = 0; i < n; ++i)
            describe(scene, from[first + i].position, directions[first + i], (found >> i & 1u) != 0, seen[first + i]);
    });
    return seen;
}

std::vector<SeenPoint> see_from_camera(const Scene& scene, std::span<const Ray> rays) {
    std::vector<SeenPoint> seen = see(scene, rays);
    if (!scene.hide_emitters) return seen;
    for_packets(rays.size(), [&](std::size_t first, std::size_t n) {
        std::uint64_t cast = 0;
        for (std::size_t i = first; i < first + n; ++i) {
            if (!seen[i].y.is_infinite() && scene.emitters.is_emitter(seen[i].y.shape)) {
                const bool is_found = pass_lights(scene.emitters, scene.geometry, rays[i].direction, seen[i].y, cast);
                seen[i] = {.y = seen[i].y};
                describe(scene, rays[i].origin, rays[i].direction, is_found, seen[i]);
            }
            seen[i].emission = Rgb(0.0);
        }
    });
    return seen;
}

std::vector<char> visible(const Scene& scene, std::span<const SurfacePoint> x, std::span<const SurfacePoint> y) {
    std::vector<char> seen(x.size());
    for_packets(x.size(), [&](std::size_t first, std::size_t n) {
        const std::uint32_t found = scene.geometry.visible(
            n, [&](std::size_t i) { return std::pair<const SurfacePoint&, const SurfacePoint&>(x[first + i], y[first + i]); },
            RayCaster::Rays::any);
        for (std::size_t i = 0; i < n; ++i) seen[first + i] = static_cast<char>(found >> i & 1u);
    });
    return seen;
}

std::vector<LightPoint> sample_lights(const Scene& scene, std::span<const SurfacePoint> x, std::span<const Vec2> u) {
    const LightSampler lights(scene.geometry, scene.emitters);
    std::vector<LightPoint> samples(x.size());
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, x.size(), 1024), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const LightSample light = lights.sample(x[i].position, u[i]);
            samples[i] = {light};
            if (light.point.is_infinite() || lights.empty()) continue;
            const Vec3 d = light.point.position - x[i].position;
            samples[i].density =
                lights.pdf(x[i].position, light.w, light.point) * std::abs(glm::dot(light.point.normal, light.w)) / glm::dot(d, d);
        }
    });
    return samples;
}

}  // namespace neumann
