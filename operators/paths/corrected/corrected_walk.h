// Corrected fields: K^k Le from approximate fields f_k and unbiased samples of their errors e_k = K^k Le − f_k, carried
// by points that all walks share (shared_points.h):
//
//     K^i Le = K f_{i−1} + K e_{i−1}
//     e_i    = (K f_{i−1} − f_i) + K e_{i−1}
//
// A walk that leaves a diffuse surface x, mostly towards where the fields are bright, reads f_k at the next one, z, and
// ends there: one ray is a sample of K f_k for all k. At x it also reads the errors of one of the shared points y:
//
//     K e_k (x) = ∫ ρ(x) g(x, y) V(x, y) e_k(y) dA(y),   g of operators/paths/walk/coupling.h
//
// g is unbounded where surfaces meet, so points carry only its part below c, min(g, c), and walks carry the rest: at z
// a walk goes on with probability 1 − c/g, and what it finds later replaces f_k(z). A walk goes on in any case from
// surfaces that are not diffuse, to surfaces without fields, and to those whose shading normals look away from it, as g
// is 0 there: where there are no fields, it is the plain walk (operators/paths/walk/walk.h). All is linear in f and in
// the points' errors, so that only the variance depends on the quality of either.
#pragma once

#include "core/base/hot.h"
#include "operators/paths/corrected/approximation.h"
#include "operators/paths/corrected/diffuse_sides.h"
#include "operators/paths/corrected/shared_points.h"
#include "operators/paths/walk/camera_walk.h"
#include "operators/paths/walk/coupling.h"
#include "operators/paths/walk/guided_continuation.h"
#include "operators/paths/walk/term_samples.h"

#include <algorithm>
#include <span>
#include <vector>

namespace neumann {

// The samples at the first diffuse vertex of a walk, where more of them help most.
struct FirstVertex {
    std::uint32_t lights = 1;      // light samples
    std::uint32_t directions = 4;  // walks that go on from it
    std::uint32_t points = 1;      // number of these walks that also read the errors of a shared point
    double clamp = 100.0;          // c, in units of 1 / (area of all sides with fields)
    double survival = 1.0;         // probability with which Russian roulette keeps walks that go on instead of reading
    // Whether paths that do not go on from it still cast a ray, whose hit counts as direct light.
    bool others_cast_rays = false;
};

// Whether a path goes on from its first diffuse vertex, and the part of the paths like it that do. The others end there with
// their light samples: direct light may need more samples than what comes after it.
struct GoingOn {
    bool goes_on = true;
    double share = 1.0;
};

struct CorrectedWalker : Walker {
    std::uint32_t path = 0;     // the camera sample, or the shared point, to which it belongs
    bool is_split = false;      // it has passed its first diffuse vertex
    bool reads = false;         // it left a diffuse vertex, so that it may read fields at the next one
    bool ends = false;          // its ray is only for the light that it hits
    double directions = 1.0;    // walks for each light sample at its last vertex
    double part_of_hits = 1.0;  // the weight of light that is hit there, relative to β
    double clamp = 0.0;         // c at that vertex, per scene unit squared
    double survival = 1.0;      // FirstVertex::survival if that was its first diffuse vertex, otherwise 1
    // The number of walks from its last vertex for which it reads a shared point (0: it reads none); the point, and the
    // weight of its errors.
    double walks_per_point = 1.0;
    std::uint32_t point = 0;
    Rgb point_weight{0.0};
};

struct CorrectedWalkers : Together<CorrectedWalker> {
    std::vector<Sampler> samplers;               // one for each walker
    std::vector<std::uint32_t> with_shadow_ray;  // walkers whose light sample or shared point needs a shadow ray
    std::vector<std::uint32_t> single, splitting;
    std::vector<float> fields;
};

class CorrectedWalk {
public:
    // c of walks after their first diffuse vertex, in units of 1 / area.
    static constexpr double later_clamp = 3.0;

    // Keeps references. `fields` may be without fields. `points` is null if walks carry all of the error.
    CorrectedWalk(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, const Approximation& fields,
                  const SharedPoints* points, const FirstVertex& first)
        : scene_(scene),
          direct_(direct),
          settings_(settings),
          fields_(fields.fields()),
          tables_(fields.tables()),
          points_(points),
          first_(first),
          of_area_(fields.area() > 0.0 ? 1.0 / fields.area() : 0.0) {}

    // Samples the terms 1 … N and the rest from walkers that stand at their first vertices (x and wo are set, β is 1),
    // and adds them to the quantities of their paths. light_sampler(path, l) and sampler_of(path, g) return the
    // samplers of the l-th light sample and of the g-th walk from the first diffuse vertex; going_on(path) a GoingOn.
    template <class LightSamplers, class Samplers, class WhichGoOn, class Observer = NoObserver>
    void operator()(CorrectedWalkers& walkers, const LightSamplers& light_sampler, const Samplers& sampler_of,
                    const WhichGoOn& going_on, TermSamples& out, const Observer& observer = {}) const;

private:
    template <class LightSamplers, class Samplers, class WhichGoOn, class Observer>
    struct Steps;

    std::size_t quantities() const { return static_cast<std::size_t>(settings_.bounces) + 2; }
    bool has_rest() const { return settings_.rest_probability > 0.0; }
    // R samples the next direction, from what the fields tell of the light that arrives (guided/direction_tables.h),
    // and chooses the shared point to be read. `wanted` is the number of later bounces that have pictures.
    bool choose_direction(CorrectedWalker& w, int wanted, Sampler& sampler) const {
        const SurfaceSide side = scene_.materials.side(w.x, w.wo);
        if (!side.bsdf) return false;
        w.reads = fields_ && !w.ends && std::holds_alternative<Diffuse>(*side.bsdf);
        const GuidedContinuation::Vertex vertex = w.reads && wanted > 0
                                                      ? GuidedContinuation::Vertex(tables_->at(w.x, w.wo, wanted), side.p.frame)
                                                      : GuidedContinuation::Vertex();
        const BsdfSample sampled = vertex.sample(side, side.p.frame.to_local(w.wo), sampler);
        w.point_weight = Rgb(0.0);
        if (w.reads && points_ && w.walks_per_point > 0.0) {
            const SharedPoints::Chosen chosen = points_->choose(w.x.position, side.p.frame.n, w.clamp, sampler.next());
            w.point = chosen.point;
            const SharedPoints::Point& y = (*points_)[chosen.point];
            if (glm::dot(y.shading, w.x.position - y.y.position) > 0.0)
                w.point_weight = w.beta * std::get<Diffuse>(*side.bsdf).reflectance(side.p) * (w.walks_per_point * chosen.weight);
        }
        w.leave(side, sampled);
        return true;
    }
    // Reads the fields at the hit z of a walk that left a diffuse surface and ends, or goes on.
    template <class Found>
    bool goes_on(CorrectedWalker& w, Sampler& sampler, std::vector<float>& fields, const Found& found) const {
        const bool front = glm::dot(w.x.normal, w.wo) > 0.0;
        if (!w.reads || !fields_->covers(w.x, front)) return true;
        const Vec3 normal = front ? w.x.normal : -w.x.normal;
        if (fields_->is_smooth(w.x) && !normals_agree(scene_.materials, w.x, normal, w.wo)) return true;
        const double g = coupling(w.from.position, w.from.normal, w.x.position, normal);
        const double left = g > w.clamp ? 1.0 - w.clamp / g : 0.0;
        const bool on = left > 0.0 && (left * w.survival >= 1.0 || sampler.next() < left * w.survival);
        const Rgb weight = on ? w.beta * (1.0 - 1.0 / w.survival) : w.beta;
        if (!on || w.survival < 1.0) {
            fields.resize(3 * fields_->size());
            fields_->read(w.x, front, fields.data());
            for (std::size_t k = 0; k < fields_->size(); ++k)
                found(k + 1, weight * Rgb(fields[3 * k], fields[3 * k + 1], fields[3 * k + 2]));
        }
        w.beta /= w.survival;
        return on;
    }

    const Scene& scene_;
    const DirectLightSampler& direct_;
    const WalkSettings& settings_;
    const FieldRaster* fields_;
    const DirectionTables* tables_;
    const SharedPoints* points_;
    FirstVertex first_;
    double of_area_;
};

template <class LightSamplers, class Samplers, class WhichGoOn, class Observer>
struct CorrectedWalk::Steps : WalkSteps<CorrectedWalkers> {
    const CorrectedWalk& walk;
    const LightSamplers& light_sampler;
    const Samplers& sampler_of;
    const WhichGoOn& going_on;
    TermSamples& out;
    const Observer& observer;

    void find(std::uint32_t i, std::size_t q, const Rgb& x) {
        out.quantities[walkers.walker[i].path * walk.quantities() + q] += x;
        observer.finds(i, q, x);
    }
    // Adds light that is found after this reflection, and that was reflected k times before.
    void find_later(std::uint32_t i, int bounce, std::size_t k, const Rgb& x) {
        const auto reflected = static_cast<std::size_t>(bounce) + k;
        if (reflected > static_cast<std::size_t>(settings.bounces) && !walk.has_rest()) return;
        find(i, std::min(reflected, walk.quantities() - 1), x);
    }
    template <class SamplerAt>
    void sample_lights(int bounce, std::size_t q, const SamplerAt& sampler_at) {
        for (std::size_t number = 0; number < direct.light_samples(); ++number) {
            walkers.keep_if([&](CorrectedWalker& w, std::uint32_t i) {
                const SurfaceSide side = scene.materials.side(w.x, w.wo);
                if (!side.bsdf) return false;
                choose_light_sample(direct, number, MaterialContinuation(), w.directions, side, side.p.frame.to_local(w.wo),
                                    sampler_at(i), w);
                return true;
            });
            rays[q] += cast_shadow_rays(scene, scene.geometry, direct, LeftOut(), bounce, walkers, observer,
                                        [&](std::uint32_t i, const Rgb& light) { find(i, q, light); });
        }
    }
    // The directions of a path from its first diffuse vertex, on average.
    double directions_of_path(double share) const {
        return share * walk.first_.directions + (walk.first_.others_cast_rays ? 1.0 - share : 0.0);
    }
    // R samples the lights. At first diffuse vertices it does so more often and splits the walk.
    void sample_lights_and_split(int bounce, std::size_t q) {
        const FirstVertex& first = walk.first_;
        walkers.single.clear();
        walkers.splitting.clear();
        for (const std::uint32_t i : walkers.alive) {
            CorrectedWalker& w = walkers.walker[i];
            const Bsdf* bsdf = w.is_split || bounce > settings.bounces ? nullptr : scene.materials.side(w.x, w.wo).bsdf;
            const bool splits = bsdf && std::holds_alternative<Diffuse>(*bsdf);
            const double directions = splits ? directions_of_path(going_on(w.path).share) : 1.0;
            w.directions = splits ? directions / first.lights : 1.0;
            w.part_of_hits = 1.0;
            w.clamp = walk.points_ ? (splits ? first.clamp : later_clamp) * walk.of_area_ : 0.0;
            w.survival = splits ? first.survival : 1.0;
            w.walks_per_point = 1.0;
            w.beta /= directions;
            (splits ? walkers.splitting : walkers.single).push_back(i);
        }
        if (!walkers.single.empty()) {
            walkers.alive = walkers.single;
            sample_lights(bounce, q, [&](std::uint32_t i) -> Sampler& { return walkers.samplers[i]; });
            walkers.single = walkers.alive;
        }
        if (!walkers.splitting.empty()) {
            walkers.alive = walkers.splitting;
            for (std::uint32_t l = 0; l < first.lights; ++l)
                sample_lights(bounce, q, [&](std::uint32_t i) -> Sampler& { return light_sampler(i, l); });
            for (const std::uint32_t i : walkers.splitting) {
                CorrectedWalker& w = walkers.walker[i];
                const GoingOn which = going_on(w.path);
                w.is_split = true;
                w.ends = !which.goes_on;
                if (w.ends) {
                    w.walks_per_point = 0.0;
                    if (first.others_cast_rays) walkers.single.push_back(i);
                    continue;
                }
                w.part_of_hits = which.share * first.directions / directions_of_path(which.share);
                w.beta /= w.part_of_hits;
                for (std::uint32_t g = 0; g < first.directions; ++g) {
                    walkers.single.push_back(static_cast<std::uint32_t>(walkers.walker.size()));
                    walkers.walker.push_back(walkers.walker[i]);
                    walkers.walker.back().walks_per_point =
                        g < first.points ? static_cast<double>(first.directions) / first.points : 0.0;
                    walkers.samplers.push_back(sampler_of(i, g));
                }
            }
        }
        walkers.alive = walkers.single;
    }
    // R also chooses directions and points, and T finds which points are visible.
    bool reflect(int bounce, std::size_t q) {
        sample_lights_and_split(bounce, q);
        walkers.with_shadow_ray.clear();
        walkers.keep_if([&](CorrectedWalker& w, std::uint32_t i) {
            if (!walk.choose_direction(w, settings.bounces - bounce, walkers.samplers[i])) return false;
            if (!is_black(w.point_weight) && !settings.ending().is_last(bounce)) walkers.with_shadow_ray.push_back(i);
            return true;
        });
        const SharedPoints* const points = walk.points_;
        test_visibility(
            scene.geometry, walkers.with_shadow_ray.size(), RayCaster::Rays::any,
            [&](std::size_t k) {
                const CorrectedWalker& w = walkers.walker[walkers.with_shadow_ray[k]];
                return std::pair<const SurfacePoint&, const SurfacePoint&>(w.x, (*points)[w.point].y);
            },
            [&](std::size_t k, bool seen) {
                const std::uint32_t i = walkers.with_shadow_ray[k];
                const CorrectedWalker& w = walkers.walker[i];
                observer.joins(i, bounce, w.x, (*points)[w.point].y, seen);
                if (!seen) return;
                const Rgb* errors = points->errors_at(w.point);
                for (std::size_t f = 1; f <= points->fields(); ++f) find_later(i, bounce, f, w.point_weight * errors[f - 1]);
            });
        rays[q] += walkers.with_shadow_ray.size();
        return true;
    }
    double directions_per_light_sample(const CorrectedWalker& w) const { return w.directions; }
    double part_of_hits(const CorrectedWalker& w) const { return w.part_of_hits; }
    // Reads the fields at z, or goes on.
    bool goes_on(CorrectedWalker& w, std::uint32_t i, int bounce) {
        return !w.ends && !settings.ending().is_last(bounce) &&
               walk.goes_on(w, walkers.samplers[i], walkers.fields,
                            [&](std::size_t k, const Rgb& x) { find_later(i, bounce, k, x); });
    }
};

template <class LightSamplers, class Samplers, class WhichGoOn, class Observer>
NEUMANN_FLAT void CorrectedWalk::operator()(CorrectedWalkers& walkers, const LightSamplers& light_sampler,
                                            const Samplers& sampler_of, const WhichGoOn& going_on, TermSamples& out,
                                            const Observer& observer) const {
    Steps<LightSamplers, Samplers, WhichGoOn, Observer> steps{
        {scene_, direct_, settings_, walkers, out.rays}, *this, light_sampler, sampler_of, going_on, out, observer};
    camera_walk(walkers.samplers, walkers, steps, out.given_up, observer);
}

}  // namespace neumann
