// Classic ray tracing (Whitted): walks from the camera that go on through mirrors and glass alone.

#include "operators/render/from_paths/path_method.h"
#include "operators/render/from_paths/term_estimators.h"
#include "operators/render/methods/method.h"

namespace neumann {

namespace {

class ClassicPaths : public PathMethod {
public:
    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    double walks_worth(int, std::span<const double>) const override { return 1.0; }
    Paths paths(const Scene&) const override { return Paths::specular; }
    void warn(const Scene& scene, Warnings& warnings) const override;
    bool ends_at_first(const Scene& scene) const override { return !has_specular(scene.materials); }
    // Points on a light that touches a surface are not bounded.
    bool is_bounded(const SamplingSettings&) const override { return false; }
    std::string why_no_balance() const override { return "by mirrors alone, a path's weight is not what arrives"; }
    std::optional<std::vector<Remedy>> remedies(const Scene&, bool) const override { return {{Remedy::sample_lights}}; }
};

std::shared_ptr<const PathSampler> ClassicPaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    return walk_sampler(scene, settings, SpecularContinuation());
}

void ClassicPaths::warn(const Scene& scene, Warnings& warnings) const {
    PathMethod::warn(scene, warnings);
    warnings.add(
        "classic makes only paths whose reflections are specular but for the last one: the light of all other paths is "
        "missing");
}

}  // namespace

namespace method {

std::optional<Decisions> Classic::leaves_out() const {
    return Decisions{&LeftOut::rays_from_surfaces, &LeftOut::rays_for_light, &LeftOut::shadow_rays_in_room};
}

std::shared_ptr<const PathMethod> Classic::prepare(const Preparing&) const { return std::make_shared<const ClassicPaths>(); }

}  // namespace method

}  // namespace neumann
