// A scene as matrices in one process: its patches, the rays of T, and for each colour channel R, Le and b = K Le.
#pragma once

#include "operators/fields/matrix/matrix_system.h"
#include "operators/fields/matrix/ray_table.h"
#include "operators/fields/matrix/traced_channel.h"

#include <cstdint>

namespace neumann {

// The patches of a TracedSystem. Throws InputError as its constructor does. `processes` is the number of processes that
// share the rays.
PatchSpace traced_space(const Scene& scene, const TracedSettings& settings, int processes = 1);

class TracedSystem : public MatrixSystem {
public:
    // Keeps a reference to the scene. Throws InputError if there are no surfaces, if no side of any surface faces another or
    // shines, and if the patches and rays need too much memory. Throws Stopped if `watch` stops it while T is traced.
    TracedSystem(const Scene& scene, const TracedSettings& settings, const Watch& watch = {});
    TracedSystem(const TracedSystem&) = delete;
    TracedSystem& operator=(const TracedSystem&) = delete;

    const Scene& scene() const override { return *scene_; }
    const TracedSettings& settings() const override { return settings_; }
    const PatchSpace& space() const override { return space_; }
    std::unique_ptr<MatrixSystem> with(const TracedSettings& settings, const Watch& watch) const override {
        return std::make_unique<TracedSystem>(*scene_, settings, watch);
    }
    const RayTable& table() const { return table_; }

    int channels() const override { return static_cast<int>(R_.size()); }
    const ReflectionMatrix<1>& reflection(int c) const { return R_[static_cast<std::size_t>(c)]; }
    // A channel of K; it refers to the table and R of this object.
    TracedChannel channel(int c) const { return {table_, reflection(c)}; }
    TracedChannel transport() const { return {table_, identity_}; }

    std::unique_ptr<ChannelOperator> reflected(int c) const override { return std::make_unique<TracedChannel>(channel(c)); }
    std::unique_ptr<ChannelOperator> transported() const override { return std::make_unique<TracedChannel>(transport()); }
    OperatorNorms norms(const ChannelOperator& K, const EigenLimits& limits) const override { return operator_norms(K, limits); }
    Eigenpairs leading(const ChannelOperator& K, int count, const EigenLimits& limits) const override {
        return leading_eigenpairs(K, count, false, limits);
    }
    PowerError error_of_power(int c, Eigen::Index one_at) const override {
        const TracedChannel K = channel(c);
        return {K.standard_error_of_power(one_at), K.measure()[one_at] / K.measure().sum()};
    }

    Vector emitted(int c) const override { return emitted_.row(c).transpose(); }
    Vector direct(int c) const override { return direct_.row(c).transpose(); }
    bool samples_lights() const override { return samples_lights_; }

    std::size_t rays() const override { return table_.seen().size(); }
    std::size_t rays_that_see_nothing() const override;

private:
    using Rows = Eigen::MatrixXd;  // one row per channel
    template <int C>
    void fill();

    const Scene* scene_;
    TracedSettings settings_;
    PatchSpace space_;
    RayTable table_;
    bool samples_lights_;
    ReflectionMatrix<1> identity_;
    std::vector<ReflectionMatrix<1>> R_;
    Rows emitted_, direct_;
};

}  // namespace neumann
