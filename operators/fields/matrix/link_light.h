// Light that reaches sides with unknowns by links (links.h), through glass or off mirrors. The rays of T rarely find
// small lamps that way, and never lights without extent, so this light is traced from the lights: light samples at
// points on the sides without unknowns, and from there on as power. The patches that receive most get most samples.
#pragma once

#include "core/emitter/light_sampler.h"
#include "operators/fields/matrix/links.h"
#include "operators/fields/matrix/patch_field.h"
#include "operators/fields/matrix/power_balance.h"
#include "operators/fields/matrix/shared_parts.h"
#include "operators/pointwise/adjoint_reflection.h"
#include "operators/watch.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <map>
#include <span>
#include <vector>

namespace neumann {

// The end of a path at a side with unknowns.
struct LinkArrival {
    const SurfacePoint& x;
    Vec3 wi;                // to where the light comes from
    std::uint32_t unknown;  // the unknown of x and wi
    std::size_t bounce;     // the bounce in which the light is reflected at x: 1 + the number of links
    Rgb power;              // W
    double index;           // refractive index at x, if it is 1 where the path begins
};

// The number of rays for LinkLight: about as many as T would have if all patches had unknowns, because the patches from
// which light goes on have none, and they may be most.
inline double rays_of_links(const PatchSpace& space, std::uint32_t rays_of_facet) {
    return static_cast<double>(std::max(space.facets().size(), space.patches().size())) * rays_of_facet;
}

class LinkLight {
public:
    // `rays` is the approximate number of rays. Keeps references to the scene and the space.
    LinkLight(const Scene& scene, const PatchSpace& space, double rays, std::uint64_t seed, int bounces);

    // The number of paths.
    std::uint64_t paths() const {
        std::uint64_t sum = 0;
        for (const Part& part : parts_) sum += part.net;
        return sum;
    }
    // The paths are traced in parts, which are independent. Calls trace(part) for several parts at the same time, and
    // add(…) with the results in the order of the parts, so that sums have the same bits on any number of threads.
    // Throws Stopped if `watch` stops it. With `rows`, each process traces some parts, and all processes add all.
    template <class Trace, class Add>
    void for_parts(const Trace& trace, const Add& add, const Watch& watch = {}, const RowShare* rows = nullptr) const {
        constexpr std::size_t at_once = 64;
        std::vector<decltype(trace(0))> found(at_once);
        for (std::size_t begin = 0; begin < parts_.size(); begin += at_once) {
            const bool shares = rows && rows->is_shared(), stops = watch.stop();
            if (shares ? rows->any(stops) : stops) throw Stopped();
            const std::size_t n = std::min(at_once, parts_.size() - begin);
            const std::vector<std::size_t> cut = shares ? rows->cut(n) : std::vector<std::size_t>{0, n};
            const std::size_t own = shares ? rows->rank() : 0;
            oneapi::tbb::parallel_for(cut[own], cut[own + 1], [&](std::size_t i) { found[i] = trace(begin + i); });
            if constexpr (requires(PackedNumbers & numbers) { found[0].pack(numbers); })
                if (shares) exchange_results(*rows, std::span(found).first(n));
            for (std::size_t i = 0; i < n; ++i) add(found[i]);
        }
    }
    // Traces the paths of a part. Calls arrive(LinkArrival) for those that end at an unknown, and adds the power on its
    // way in the bounces 0, 1, … to `power`, without the power that arrives. Returns the number of rays cast.
    template <class Arrive>
    std::uint64_t trace(std::size_t part, std::span<PowerOfTerm> power, const Arrive& arrive) const {
        const Part& p = parts_[part];
        Sampler sampler(points_.at(p.net), seed_, p.reflector);
        std::uint64_t rays = p.net;
        light(reflectors_[p.reflector], sampler, p.first, p.net, p.samples,
              [&](const SurfacePoint& x, const Vec3& w, const Rgb& begun) {
                  Rgb now = begun;
                  std::size_t bounce = 0;
                  bool arrived = false;
                  links_.follow<Reflection>(
                      x, -w, sampler,
                      [&](const Rgb& weight) {
                          const Rgb next = begun * weight;
                          if (bounce < power.size()) {
                              power[bounce].caught += mean_component(now);
                              power[bounce].absorbed += mean_component(now - next);
                          }
                          if (++bounce < power.size()) power[bounce].emitted += mean_component(next);
                          now = next;
                          ++rays;
                      },
                      [&](const SurfacePoint& met, const Vec3& along, std::uint32_t unknown, double index) {
                          arrive(LinkArrival{met, -along, unknown, bounce + 1, now, index});
                          arrived = true;
                      });
                  if (!arrived && bounce < power.size()) power[bounce].left += mean_component(now);
              });
        return rays;
    }

private:
    // A side of a patch that reflects and has no unknowns.
    struct Reflector {
        std::uint32_t patch;
        bool front;
    };
    struct Part {
        std::uint32_t reflector, first, net;  // samples first … first + net − 1
        std::uint32_t samples;                // all samples of the reflector
    };
    // R* at a link, with the change of the refractive index.
    struct Reflection {
        Vec3 wi;
        Rgb weight;
        double index;
        static Reflection sample(const Materials& materials, const SurfaceSide& side, const Vec3& back, const Vec2& u) {
            const AdjointReflection::Sample s = AdjointReflection::sample(materials, side, back, u);
            const bool passes = glm::dot(side.p.normal, s.wo) * glm::dot(side.p.normal, back) < 0.0;
            return {s.wo, s.weight, passes ? refractive_ratio(*side.bsdf) : 1.0};
        }
    };
    // Calls each(x, w, power) with the power, in W per sample, that arrives at a point x of the reflector from the direction w.
    template <class Each>
    void light(const Reflector& reflector, Sampler& sampler, std::uint32_t first, std::uint32_t count, double samples,
               const Each& each) const {
        const double area = space_->patches().area(reflector.patch) / samples;
        for (std::uint32_t i = first; i < first + count; ++i) {
            sampler.start(i);
            const Vec2 u = sampler.next2();
            const SurfacePoint x = space_->patches().point(reflector.patch, sampler.next2());
            const LightSample y = lights_.sample({x.position, reflector.front ? x.normal : -x.normal}, u);
            const double cosine = (reflector.front ? 1.0 : -1.0) * glm::dot(x.normal, y.w);
            if (!(y.pdf > 0.0) || !(cosine > 0.0) || !geometry_->visible(x, y.point)) continue;
            each(x, y.w, y.weight * (cosine * area));
        }
    }
    void find_reflectors(const Scene& scene);
    void divide(double samples, std::uint64_t seed);

    const PatchSpace* space_;
    const Geometry* geometry_;
    LightSampler lights_;
    Links links_;
    std::uint64_t seed_;
    std::vector<Reflector> reflectors_;
    std::vector<Part> parts_;
    std::map<std::uint32_t, SobolPoints> points_;  // by size of the net
};

template <int C>
struct ArrivingByLinks {
    // Mean incident radiance over each cell that is reflected in bounce k = 1 … N. The last entry, N + 1, is for all
    // later bounces together; entry 0 is zero, and entry 1 too if N > 0.
    std::vector<IncidentVector<C>> radiance;
    std::vector<PowerOfTerm> power;  // on its way in the bounces 0 … N
    std::uint64_t rays = 0;
};

template <int C>
ArrivingByLinks<C> arriving_by_links(const Scene& scene, const RowShare& rows, double rays, std::uint64_t seed, int bounces,
                                     const Watch& watch = {});

}  // namespace neumann
