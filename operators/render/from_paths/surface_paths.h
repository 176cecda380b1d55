// Walks from the camera that choose the next vertex uniformly by area on all surfaces.
#pragma once

#include "operators/render/from_paths/path_method.h"

namespace neumann {

class SurfacePaths : public PathMethod {
public:
    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    double walks_worth(int, std::span<const double>) const override { return 1.0; }
    Paths paths(const Scene& scene) const override;
    void warn(const Scene& scene, Warnings& warnings) const override;
    // 1/d² is not, where vertices are on surfaces that touch.
    bool is_bounded(const SamplingSettings&) const override { return false; }
    std::string why_no_balance() const override { return "by points on surfaces, a path's weight is not what arrives"; }
    bool rays_meet_surfaces() const override { return false; }
    std::optional<std::vector<Remedy>> remedies(const Scene&, bool) const override { return {{Remedy::ask_lights}}; }
};

}  // namespace neumann
