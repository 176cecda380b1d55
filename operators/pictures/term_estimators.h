// The ways to sample all terms along a camera ray, behind one call: estimator(ray, sampler, result).
#pragma once

#include "operators/pointwise/emission.h"
#include "operators/pointwise/reflection.h"
#include "operators/pointwise/transport.h"
#include "operators/series/neumann_series.h"
#include "operators/walk/walk.h"

#include <memory>

namespace neumann {

// One walk for all terms: the fast way.
class WalkEstimator {
public:
    WalkEstimator(const Scene& scene, const WalkSettings& settings) : scene_(&scene), settings_(settings) {}

    template <class Sampler>
    void operator()(const CameraRay& ray, Sampler& sampler, TermSamples& result) const {
        walk(*scene_, scene_->geometry, settings_, ray, sampler, result);
    }

private:
    const Scene* scene_;
    WalkSettings settings_;
};

// Each term asked for its value, by itself and from the start: the slow way, as on the slide. It has no rest.
class PointwiseEstimator {
public:
    PointwiseEstimator(const Scene& scene, int bounces) : scene_(&scene) {
        const TransportOperator T(scene.geometry);
        const ReflectionOperator R(scene.materials);
        const auto K = R * T;
        NeumannSeries series(K, emission(scene.emitters));
        for (terms_.push_back(series.term()); series.bounce() < bounces; terms_.push_back(series.term())) series.advance();
    }

    template <class Sampler>
    void operator()(const CameraRay& ray, Sampler& sampler, TermSamples& result) const {
        struct FromSampler : Random {
            explicit FromSampler(Sampler& s) : sampler(s) {}
            double next() override { return sampler.next(); }
            Sampler& sampler;
        } random(sampler);
        for (std::size_t i = 0; i < terms_.size(); ++i) result.rays[i] += i + 1;
        const auto seen = scene_->geometry.first_hit(ray.origin, ray.direction, ray.length);
        if (!seen) return;
        for (std::size_t i = 0; i < terms_.size(); ++i) result.quantities[i] += terms_[i](*seen, -ray.direction, random);
    }

private:
    const Scene* scene_;
    std::vector<ExitantField> terms_;
};

}  // namespace neumann
