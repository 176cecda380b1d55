// Evaluates each term recursively from the start, as written in the equations: slow, and without a rest.

#include "core/base/error.h"
#include "core/scene/pass_lights.h"
#include "operators/algebra/neumann_series.h"
#include "operators/pointwise/emission.h"
#include "operators/pointwise/reflection.h"
#include "operators/pointwise/transport.h"
#include "operators/render/from_paths/path_method.h"
#include "operators/render/from_paths/term_estimators.h"
#include "operators/render/methods/method.h"

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

class PointwisePaths : public PathMethod {
public:
    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    double walks_worth(int, std::span<const double>) const override { return 1.0; }
    bool has_rest() const override { return false; }
    bool is_bounded(const SamplingSettings&) const override { return true; }
    std::string why_no_checkup() const override { return "every bounce has a path of its own"; }
    std::optional<std::vector<Remedy>> remedies(const Scene& scene, bool) const override {
        return {{scene.hide_emitters ? Remedy::sample_lights : Remedy::bidirectional}};
    }
};

std::shared_ptr<const PathSampler> PointwisePaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    return std::make_shared<const EstimatorSampler>(scene, settings,
                                                    std::make_unique<const PointwiseEstimator>(scene, settings.walk.bounces));
}

}  // namespace

namespace method {

void Pointwise::expect(const Scene& scene) const {
    if (scene.emitters.has_delta_lights())
        throw InputError(
            "pointwise finds lights by chance, and no ray meets a light without extent (directional, directionalarea, "
            "point, projector, spot), of which the scene has some; take walk, matrix or gather");
}

std::shared_ptr<const PathMethod> Pointwise::prepare(const Preparing&) const { return std::make_shared<const PointwisePaths>(); }

}  // namespace method

}  // namespace neumann
