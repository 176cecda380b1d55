// Classic ray tracing (Whitted): walks from the camera that go on through mirrors and glass alone.
#pragma once

#include "operators/render/from_paths/path_method.h"

namespace neumann {

class ClassicPaths : public PathMethod {
public:
    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    double walks_worth(int, std::span<const double>) const override { return 1.0; }
    Paths paths(const Scene&) const override { return Paths::specular; }
    void warn(const Scene& scene, Warnings& warnings) const override;
    bool ends_at_first(const Scene& scene) const override { return !has_specular(scene.materials); }
    // Points on a light that touches a surface are not.
    bool is_bounded(const SamplingSettings&) const override { return false; }
    std::string why_no_balance() const override { return "by mirrors alone, a path's weight is not what arrives"; }
    std::optional<std::vector<Remedy>> remedies(const Scene&, bool) const override { return {{Remedy::ask_lights}}; }
};

}  // namespace neumann
