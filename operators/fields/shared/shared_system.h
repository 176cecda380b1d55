// A scene as matrices that several processes share. Each process has all patches, and the parts of T, R and all vectors
// that belong to its own unknowns.
#pragma once

#include "operators/fields/matrix/matrix_system.h"
#include "operators/fields/shared/shared_channel.h"

#include <string>

namespace neumann {

class SharedSystem : public MatrixSystem {
public:
    // All processes construct it together; the conditions are those of TracedSystem's constructor. `petsc` has SLEPc's
    // options for leading().
    SharedSystem(const Scene& scene, const TracedSettings& settings, Processes& processes, std::string petsc = "",
                 const Watch& watch = {});
    SharedSystem(const SharedSystem&) = delete;
    SharedSystem& operator=(const SharedSystem&) = delete;

    const Scene& scene() const override { return *scene_; }
    const TracedSettings& settings() const override { return settings_; }
    const PatchSpace& space() const override { return space_; }
    const SharedRays& table() const { return table_; }
    std::size_t rays() const override { return rays_; }
    std::size_t rays_that_see_nothing() const override { return blind_; }
    bool samples_lights() const override { return samples_lights_; }
    std::unique_ptr<MatrixSystem> with(const TracedSettings& settings, const Watch& watch) const override {
        return std::make_unique<SharedSystem>(*scene_, settings, *processes_, petsc_, watch);
    }

    int channels() const override { return static_cast<int>(R_.size()); }
    SharedChannel channel(int c) const { return {table_, R_[static_cast<std::size_t>(c)]}; }
    Vector emitted(int c) const override { return emitted_[static_cast<std::size_t>(c)]; }
    Vector direct(int c) const override { return direct_[static_cast<std::size_t>(c)]; }

    std::unique_ptr<ChannelOperator> reflected(int c) const override { return std::make_unique<SharedChannel>(channel(c)); }
    std::unique_ptr<ChannelOperator> transported() const override;
    OperatorNorms norms(const ChannelOperator& K, const EigenLimits& limits) const override;
    Eigenpairs leading(const ChannelOperator& K, int count, const EigenLimits& limits) const override;
    PowerError error_of_power(int c, Eigen::Index one_at) const override;

private:
    template <int C>
    void fill();

    const Scene* scene_;
    TracedSettings settings_;
    Processes* processes_;
    std::string petsc_;
    PatchSpace space_;
    SharedRays table_;
    bool samples_lights_;
    std::size_t rays_ = 0, blind_ = 0;
    std::vector<ReflectionMatrix<1>> R_;
    std::vector<Vector> emitted_, direct_;
};

}  // namespace neumann
