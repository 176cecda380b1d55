// Walks from the camera that choose the next vertex uniformly by area on all surfaces.

#include "operators/render/from_paths/path_method.h"
#include "operators/render/from_paths/term_estimators.h"
#include "operators/render/methods/method.h"

namespace neumann {

namespace {

class SurfacePaths : public PathMethod {
public:
    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    double walks_worth(int, std::span<const double>) const override { return 1.0; }
    Paths paths(const Scene& scene) const override;
    void warn(const Scene& scene, Warnings& warnings) const override;
    // 1/d² is unbounded if vertices are on surfaces that touch.
    bool is_bounded(const SamplingSettings&) const override { return false; }
    std::string why_no_balance() const override { return "by points on surfaces, a path's weight is not what arrives"; }
    bool rays_meet_surfaces() const override { return false; }
    std::optional<std::vector<Remedy>> remedies(const Scene&, bool) const override { return {{Remedy::sample_lights}}; }
};

std::shared_ptr<const PathSampler> SurfacePaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    return walk_sampler(scene, settings, SurfaceContinuation(scene.geometry));
}

Paths SurfacePaths::paths(const Scene& scene) const { return has_specular(scene.materials) ? Paths::without_specular : Paths::all; }

void SurfacePaths::warn(const Scene& scene, Warnings& warnings) const {
    PathMethod::warn(scene, warnings);
    if (paths(scene) == Paths::without_specular)
        warnings.add(
            "surface makes no path by way of a mirror, of glass or of anything else that sends light in a single "
            "direction: what these reflect and let through is missing");
    warnings.add("where surfaces meet at an angle, the variance of surface is infinite, even if the samples do not show it");
}

}  // namespace

namespace method {

std::optional<Decisions> Surface::leaves_out() const {
    return Decisions{&LeftOut::rays_from_surfaces, &LeftOut::rays_for_light, &LeftOut::shadow_rays_in_room};
}

std::shared_ptr<const PathMethod> Surface::prepare(const Preparing&) const { return std::make_shared<const SurfacePaths>(); }

}  // namespace method

}  // namespace neumann
