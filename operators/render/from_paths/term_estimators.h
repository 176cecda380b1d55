// Estimators of all terms along camera rays with one interface: estimator(rays, samplers, workspace, result). Walks can report to
// an observer (path_observer.h; retrace.cpp).
#pragma once

#include "core/scene/pass_lights.h"
#include "operators/algebra/neumann_series.h"
#include "operators/paths/reuse/reusing_walk.h"
#include "operators/paths/walk/guided_continuation.h"
#include "operators/paths/walk/path_observer.h"
#include "operators/paths/walk/tree_ratios.h"
#include "operators/paths/walk/tree_walk.h"
#include "operators/paths/walk/walks.h"
#include "operators/pointwise/emission.h"
#include "operators/pointwise/reflection.h"
#include "operators/pointwise/transport.h"
#include "operators/render/from_paths/sampling_settings.h"

#include <memory>
#include <utility>
#include <variant>

namespace neumann {

// One walk for all terms: the fast way.
template <class Continuation>
class WalkEstimator {
public:
    WalkEstimator(const Scene& scene, const WalkSettings& settings, const Continuation& continuation)
        : scene_(&scene), settings_(settings), direct_(scene, asked(settings)), continuation_(continuation) {}

    void operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers& walkers, TermSamples& result) const {
        walk(*scene_, direct_, settings_, rays, samplers, walkers, result, continuation_);
    }
    // With an observer: leaves nothing out, so it also reports rays whose results were known without casting them.
    void trace(PathObserver& observer, std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers& walkers,
               TermSamples& result) const;

private:
    // If BSDF sampling alone is enough (LeftOut::questions), the lights are not sampled.
    static DirectLightSettings asked(const WalkSettings& settings) {
        DirectLightSettings direct = settings.direct;
        if (settings.left_out.questions && direct.direct == DirectLight::mis) direct.direct = DirectLight::bsdf;
        return direct;
    }

    const Scene* scene_;
    WalkSettings settings_;
    DirectLightSampler direct_;
    Continuation continuation_;
};

// Each term is evaluated recursively from the start, as written in the equations: slow, and without a rest.
class PointwiseEstimator {
public:
    PointwiseEstimator(const Scene& scene, int bounces) : scene_(&scene) {
        const TransportOperator T(scene.geometry);
        const ReflectionOperator R(scene.materials);
        const auto K = R * T;
        NeumannSeries series(K, emission(scene.emitters));
        for (terms_.push_back(series.term()); series.bounce() < bounces; terms_.push_back(series.term())) series.advance();
    }

    void operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&, TermSamples& result) const {
        struct FromSampler : Random {
            explicit FromSampler(Sampler& s) : sampler(s) {}
            double next() override { return sampler.next(); }
            Sampler& sampler;
        };
        for (std::size_t i = 0; i < rays.size(); ++i) {
            for (std::size_t k = 0; k < terms_.size(); ++k) result.rays[k] += k + 1;
            const CameraRay& ray = rays[i];
            SurfacePoint seen;
            const bool hit = scene_->geometry.first_hit(ray.origin, ray.direction, ray.length, seen);
            if (!hit) seen.shape = SurfacePoint::infinity;
            if (scene_->hide_emitters &&
                (!hit || !pass_lights(scene_->emitters, scene_->geometry, ray.direction, seen, result.rays[0])))
                continue;
            FromSampler random(samplers[i]);
            const auto quantities = result.quantities.subspan(i * (terms_.size() + 1), terms_.size());
            for (std::size_t k = 0; k < terms_.size(); ++k) quantities[k] += terms_[k](seen, -ray.direction, random);
        }
    }

private:
    const Scene* scene_;
    std::vector<ExitantField> terms_;
};

// A walk that splits and ends by the best numbers for its depths.
class TreeEstimator {
public:
    TreeEstimator(const Scene& scene, const WalkSettings& settings, std::shared_ptr<const TreeRatios> ratios)
        : scene_(&scene), settings_(settings), direct_(scene, settings.direct), ratios_(std::move(ratios)) {}

    void operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&, TermSamples& result) const {
        TreeWalkers tree;
        walk_tree(*scene_, direct_, settings_, ratios_->of_depths, rays, samplers, tree, result);
    }
    void trace(PathObserver& observer, std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&,
               TermSamples& result) const;

private:
    const Scene* scene_;
    WalkSettings settings_;
    DirectLightSampler direct_;
    std::shared_ptr<const TreeRatios> ratios_;
};

// Walks that use each other's tails. Their pixels are not independent.
class ReusingEstimator {
public:
    ReusingEstimator(const Scene& scene, const SamplingSettings& settings)
        : scene_(&scene),
          settings_(settings.walk),
          size_(settings.replicate_size),
          sharing_(settings.sharing_pixels),
          direct_(scene, settings.walk.direct),
          diffuse_(scene, Normals::geometric) {}

    void operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&, TermSamples& result) const {
        walk_reusing(*scene_, direct_, diffuse_, settings_, size_, sharing_, rays, samplers, result,
                     [&](const WalkSettings& settings, std::span<Sampler> random, Walkers& tails, TermSamples& found, const auto&) {
                         walk_on(*scene_, direct_, settings, random, tails, found, MaterialContinuation());
                     });
    }
    void trace(PathObserver& observer, std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&,
               TermSamples& result) const;

private:
    const Scene* scene_;
    WalkSettings settings_;
    std::size_t size_, sharing_;  // samples of a pixel; pixels in a row
    DirectLightSampler direct_;
    DiffuseSides diffuse_;
};

using TermEstimator =
    std::variant<WalkEstimator<MaterialContinuation>, WalkEstimator<SurfaceContinuation>, WalkEstimator<SpecularContinuation>,
                 WalkEstimator<GuidedContinuation>, TreeEstimator, ReusingEstimator, PointwiseEstimator>;
TermEstimator make_estimator(const Scene& scene, const SamplingSettings& settings);

}  // namespace neumann
