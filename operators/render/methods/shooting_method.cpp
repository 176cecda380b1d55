// Source shooting (Dutré): walks from the lights, every vertex of which is joined to the point that the camera sees.
#include "operators/paths/bidirectional/bidirectional.h"
#include "operators/render/from_paths/path_method.h"
#include "operators/render/from_paths/term_estimators.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/sampling.h"
#include "operators/render/report/watched_paths.h"

namespace neumann {

namespace {

// Of the ways (s, t) of bidirectional paths those with the least t that is possible, each with all the weight.
class ShootingEstimator : public TermEstimator {
public:
    ShootingEstimator(const Scene& scene, const WalkSettings& settings)
        : bounces_(settings.bounces), paths_(scene, settings, 1.0) {}

    void operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&, TermSamples& result) const override {
        shoot(rays, samplers, result, NoObserver());
    }
    void trace(PathObserver& observer, std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&,
               TermSamples& result) const override {
        shoot(rays, samplers, result, WatchedPaths(observer));
    }

private:
    template <class Observer>
    void shoot(std::span<const CameraRay> rays, std::span<Sampler> samplers, TermSamples& result, const Observer& observer) const {
        const std::size_t Q = static_cast<std::size_t>(bounces_) + 2;
        BidirectionalWork work;
        const auto found = [&](std::uint32_t i, const WayContribution& light) {
            if (light.bounce > bounces_) return;
            const auto bounce = static_cast<std::size_t>(light.bounce);
            result.quantities[i * Q + bounce] += light.value;
            observer.finds(i, bounce, light.value);
        };
        // The light's path draws its numbers first, from the best dimensions.
        result.given_up += paths_.trace(
            rays, samplers, samplers, work, found, [](auto&&...) {}, result.rays, observer, WaysToTheReceiver());
    }

    int bounces_;
    Bidirectional paths_;
};

class ShootingPaths : public PathMethod {
public:
    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    double walks_worth(int, std::span<const double>) const override { return 3.0; }
    Paths paths(const Scene& scene) const override { return has_specular(scene.materials) ? Paths::without_caustics : Paths::all; }
    void warn(const Scene& scene, Warnings& warnings) const override;
    bool has_rest() const override { return false; }
    bool starts_at_lights() const override { return true; }
    // 1/d² is unbounded if vertices are on surfaces that touch.
    bool is_bounded(const SamplingSettings&) const override { return false; }
    std::string why_no_balance() const override { return "of paths from the lights, a path's weight is not what arrives"; }
    std::optional<std::vector<Remedy>> remedies(const Scene&, bool) const override { return {{Remedy::sample_lights}}; }
};

std::shared_ptr<const PathSampler> ShootingPaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    WalkSettings walk = settings.walk;
    walk.rest_probability = 0.0;
    return std::make_shared<const EstimatorSampler>(scene, settings, std::make_unique<const ShootingEstimator>(scene, walk));
}

void ShootingPaths::warn(const Scene& scene, Warnings& warnings) const {
    PathMethod::warn(scene, warnings);
    if (paths(scene) == Paths::without_caustics)
        warnings.add(
            "shooting makes no path whose light comes from a mirror, through glass or from anything else that sends light in a "
            "single "
            "direction onto the point to which it is joined: these are missing");
    warnings.add("where surfaces meet at an angle, the variance of shooting is infinite, even if the samples do not show it");
}

}  // namespace

namespace method {

void Shooting::expect(const Scene& scene) const { expect_visible_emitters(name, scene); }

std::shared_ptr<const PathMethod> Shooting::prepare(const Preparing&) const { return std::make_shared<const ShootingPaths>(); }

}  // namespace method

}  // namespace neumann
