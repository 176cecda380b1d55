#include "operators/render/from_paths/pointwise_paths.h"

#include "core/scene/pass_lights.h"
#include "operators/algebra/neumann_series.h"
#include "operators/pointwise/emission.h"
#include "operators/pointwise/reflection.h"
#include "operators/pointwise/transport.h"
#include "operators/render/from_paths/term_estimators.h"

#include <stdexcept>

namespace neumann {

namespace {

class PointwiseEstimator : public TermEstimator {
public:
    PointwiseEstimator(const Scene& scene, int bounces) : scene_(&scene) {
        const TransportOperator T(scene.geometry);
        const ReflectionOperator R(scene.materials);
        const auto K = R * T;
        NeumannSeries series(K, emission(scene.emitters));
        for (terms_.push_back(series.term()); series.bounce() < bounces; terms_.push_back(series.term())) series.advance();
    }

    void operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&, TermSamples& result) const override {
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

    void trace(PathObserver&, std::span<const CameraRay>, std::span<Sampler>, Walkers&, TermSamples&) const override {
        throw std::logic_error("PointwisePaths: each bounce is asked for anew, and there are no paths");
    }

private:
    const Scene* scene_;
    std::vector<ExitantField> terms_;
};

}  // namespace

std::shared_ptr<const PathSampler> PointwisePaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    return std::make_shared<const EstimatorSampler>(scene, settings,
                                                    std::make_unique<const PointwiseEstimator>(scene, settings.walk.bounces));
}

}  // namespace neumann
