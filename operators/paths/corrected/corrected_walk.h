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
// is 0 there: where there are no fields, it is the plain walk (operators/paths/walk/walk.h). Where paths from the lamps make
// caustics (caustics.h), a second list of points carries these, and walks leave them out. All is linear in f and in
// the points' errors, so that only the variance depends on the quality of either.
#pragma once

#include "core/base/hot.h"
#include "operators/paths/corrected/approximation.h"
#include "operators/paths/corrected/caustics.h"
#include "operators/paths/corrected/shared_points.h"
#include "operators/paths/walk/camera_walk.h"
#include "operators/paths/walk/guided_continuation.h"
#include "operators/paths/walk/term_samples.h"

#include <algorithm>
#include <array>
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

// The points that walks join.
struct JoinedPoints {
    const SharedPoints* errors = nullptr;    // of the fields
    const SharedPoints* caustics = nullptr;  // that no field has (caustics.h)
};

// The caustics that walks leave to paths from the lamps: at their first vertices, if these are diffuse, up to this bounce; and, if
// the lamps also make what caustics light, at their second diffuse vertices.
struct CausticsLeft {
    const Caustics* to = nullptr;
    int bounces = 0;
    bool at_second = false;
    const DirectionTables* tables = nullptr;  // for the vertices whose caustics walks make
};

struct CorrectedWalker : Walker {
    std::uint32_t path = 0;  // the camera sample, or the shared point, to which it belongs
    bool is_split = false;   // it has passed its first diffuse vertex
    bool reads = false;      // it left a diffuse vertex, so that it may read fields at the next one
    bool ends = false;       // its ray is only for the light that it hits
    // What has reflected it since the camera: D S … or D (S …) D S …, where paths from the lamps bring the light that S meets
    // (caustics.h).
    enum class ToCaustics : std::uint8_t { no, from_first, from_second } to_caustics = ToCaustics::no;
    double directions = 1.0;    // walks for each light sample at its last vertex
    double part_of_hits = 1.0;  // the weight of light that is hit there, relative to β
    double clamp = 0.0;         // c at that vertex, per scene unit squared
    double survival = 1.0;      // FirstVertex::survival if that was its first diffuse vertex, otherwise 1
    // The number of walks from its last vertex for which it reads a shared point (0: it reads none); the point, and the
    // weight of its errors.
    double walks_per_point = 1.0;
    struct Joined {
        std::uint32_t point = 0;
        Rgb weight{0.0};
    };
    std::array<Joined, 2> joined;  // in the order of JoinedPoints
};

struct CorrectedWalkers : Together<CorrectedWalker> {
    std::vector<Sampler> samplers;               // one for each walker
    std::vector<std::uint32_t> with_shadow_ray;  // walkers whose light sample needs a shadow ray
    struct Joins {
        std::uint32_t walker, list;
    };
    std::vector<Joins> joins;  // of points that need a shadow ray
    std::vector<std::uint32_t> single, splitting;
    std::vector<float> fields;
};

class CorrectedWalk {
public:
    // c of walks after their first diffuse vertex, in units of 1 / area.
    static constexpr double later_clamp = 3.0;

    // Keeps references. `fields` may be without fields. Without points of errors walks carry all of the error.
    CorrectedWalk(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, const Approximation& fields,
                  const JoinedPoints& points, const CausticsLeft& caustics, const FirstVertex& first)
        : scene_(scene),
          direct_(direct),
          settings_(settings),
          fields_(fields.fields()),
          tables_(fields.tables()),
          points_{points.errors, points.caustics},
          caustics_(caustics),
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
    // and chooses the shared point to be read.
    bool choose_direction(CorrectedWalker& w, int bounce, Sampler& sampler) const {
        const SurfaceSide side = scene_.materials.side(w.x, w.wo);
        if (!side.bsdf) return false;
        const bool is_diffuse = std::holds_alternative<Diffuse>(*side.bsdf);
        const int wanted = settings_.bounces - bounce;  // later bounces that have pictures
        w.reads = fields_ && !w.ends && is_diffuse;
        const bool makes_caustics =
            caustics_.tables && after_vertex(w.to_caustics, bounce, is_diffuse, false) == CorrectedWalker::ToCaustics::no;
        const DirectionTables* const tables = makes_caustics ? caustics_.tables : tables_;
        const GuidedContinuation::Vertex vertex = w.reads && wanted > 0
                                                      ? GuidedContinuation::Vertex(tables->at(w.x, w.wo, wanted), side.p.frame)
                                                      : GuidedContinuation::Vertex();
        const BsdfSample sampled = vertex.sample(side, side.p.frame.to_local(w.wo), sampler);
        for (std::size_t list = 0; list < points_.size(); ++list) {
            CorrectedWalker::Joined& joined = w.joined[list];
            joined.weight = Rgb(0.0);
            if (!w.reads || !points_[list] || w.walks_per_point == 0.0 || w.clamp == 0.0) continue;
            const SharedPoints::Chosen chosen = points_[list]->choose(w.x.position, side.p.frame.n, w.clamp, sampler.next());
            joined.point = chosen.point;
            const SharedPoints::Point& y = (*points_[list])[chosen.point];
            if (glm::dot(y.shading, w.x.position - y.y.position) > 0.0)
                joined.weight = w.beta * std::get<Diffuse>(*side.bsdf).reflectance(side.p) * (w.walks_per_point * chosen.weight);
        }
        if (caustics_.to) w.to_caustics = after_vertex(w.to_caustics, bounce, is_diffuse, sampled.pdf == delta_pdf);
        w.leave(side, sampled);
        return true;
    }
    CorrectedWalker::ToCaustics after_vertex(CorrectedWalker::ToCaustics before, int bounce, bool is_diffuse, bool by_delta) const {
        using enum CorrectedWalker::ToCaustics;
        if (bounce > caustics_.bounces) return no;
        if (bounce == 1) return is_diffuse ? from_first : no;
        return by_delta ? before : caustics_.at_second && before == from_first && is_diffuse ? from_second : no;
    }
    // Reads the fields at the hit z of a walk that left a diffuse surface and ends, or goes on.
    template <class Found>
    bool goes_on(CorrectedWalker& w, Sampler& sampler, std::vector<float>& fields, const Found& found) const {
        if (!w.reads) return true;
        const auto left = share_of_walks(scene_.materials, fields_, w.from.position, w.from.normal, w.x, w.wo, w.clamp);
        if (!left) return true;
        const double going_on = *left * w.survival;
        const bool on = going_on > 0.0 && (going_on >= 1.0 || sampler.next() < going_on);
        const Rgb weight = on ? w.beta * (1.0 - 1.0 / w.survival) : w.beta;
        if (!on || w.survival < 1.0) {
            fields.resize(3 * fields_->size());
            fields_->read(w.x, glm::dot(w.x.normal, w.wo) > 0.0, fields.data());
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
    std::array<const SharedPoints*, 2> points_;
    CausticsLeft caustics_;
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
                choose_light_sample(direct, {number}, MaterialContinuation(), w.directions, side, side.p.frame.to_local(w.wo),
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
            w.clamp = walk.points_[0] ? (splits ? first.clamp : later_clamp) * walk.of_area_ : 0.0;
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
        walkers.joins.clear();
        walkers.keep_if([&](CorrectedWalker& w, std::uint32_t i) {
            if (!walk.choose_direction(w, bounce, walkers.samplers[i])) return false;
            for (std::uint32_t list = 0; list < w.joined.size(); ++list)
                if (!is_black(w.joined[list].weight) && !settings.ending().is_last(bounce)) walkers.joins.push_back({i, list});
            return true;
        });
        const auto point_of = [&](const CorrectedWalkers::Joins& joins) -> const SurfacePoint& {
            return (*walk.points_[joins.list])[walkers.walker[joins.walker].joined[joins.list].point].y;
        };
        test_visibility(
            scene.geometry, walkers.joins.size(), RayCaster::Rays::any,
            [&](std::size_t k) {
                const CorrectedWalkers::Joins& joins = walkers.joins[k];
                return std::pair<const SurfacePoint&, const SurfacePoint&>(walkers.walker[joins.walker].x, point_of(joins));
            },
            [&](std::size_t k, bool seen) {
                const auto [i, list] = walkers.joins[k];
                const CorrectedWalker& w = walkers.walker[i];
                observer.joins(i, bounce, w.x, point_of(walkers.joins[k]), seen);
                if (!seen) return;
                const SharedPoints& points = *walk.points_[list];
                const Rgb* carried = points.carried_by(w.joined[list].point);
                for (std::size_t f = 1; f <= points.fields(); ++f) find_later(i, bounce, f, w.joined[list].weight * carried[f - 1]);
            });
        rays[q] += walkers.joins.size();
        return true;
    }
    bool counts_hit(const CorrectedWalker& w, std::uint32_t i) const {
        if (w.to_caustics != CorrectedWalker::ToCaustics::no && w.pdf == delta_pdf && walk.caustics_.to->bring(w.x, w.w))
            return false;
        return WalkSteps<CorrectedWalkers>::counts_hit(w, i);
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
