// Each term is evaluated recursively from the start, as written in the equations: slow, and without a rest.
#pragma once

#include "operators/render/from_paths/path_method.h"

namespace neumann {

class PointwisePaths : public PathMethod {
public:
    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    double walks_worth(int, std::span<const double>) const override { return 1.0; }
    bool has_rest() const override { return false; }
    bool is_bounded(const SamplingSettings&) const override { return true; }
    std::string why_no_checkup() const override { return "every bounce has a path of its own"; }
    std::optional<std::vector<Remedy>> remedies(const Scene& scene, bool) const override {
        return {{scene.hide_emitters ? Remedy::ask_lights : Remedy::bidirectional}};
    }
};

}  // namespace neumann
