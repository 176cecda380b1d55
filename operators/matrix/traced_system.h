// A scene as matrices: its patches, the rays of T, and for each colour channel R, Le and b = K Le.
#pragma once

#include "core/base/memory.h"
#include "core/scene/scene.h"
#include "operators/matrix/ray_table.h"
#include "operators/matrix/traced_channel.h"

#include <cstdint>

namespace neumann {

struct TracedSettings {
    std::size_t patches = 2000;  // approximate number; at least one per chart
    std::uint32_t rays = 64;     // per facet; a power of two. Also the number of light samples per facet
    std::uint64_t seed = 0;
    double memory = default_memory();  // approximate limit in bytes
};

class TracedSystem {
public:
    // Keeps a reference to the scene. Throws InputError if there are no surfaces, if no side of any surface faces another, and if
    // the patches and rays need too much memory. Throws Stopped if `watch` stops it while T is
    // traced.
    TracedSystem(const Scene& scene, const TracedSettings& settings, const Watch& watch = {});
    TracedSystem(const TracedSystem&) = delete;
    TracedSystem& operator=(const TracedSystem&) = delete;

    const Scene& scene() const { return *scene_; }
    const TracedSettings& settings() const { return settings_; }
    const PatchSpace& space() const { return space_; }
    const RayTable& table() const { return table_; }

    // 1 if the scene is grey, otherwise 3.
    int channels() const { return static_cast<int>(R_.size()); }
    // "grey", or "red", "green", "blue".
    const char* channel_name(int c) const;
    const ReflectionMatrix<1>& reflection(int c) const { return R_[static_cast<std::size_t>(c)]; }
    // A channel of K; it refers to the table and R of this object.
    TracedChannel channel(int c) const { return {table_, reflection(c)}; }
    // T alone: a row is the mean over its rays, so T 1 = 1 in a closed scene.
    TracedChannel transport() const { return {table_, identity_}; }

    // Largest albedo for basic radiance.
    double largest_albedo(int c) const { return scene_->materials.largest_basic_albedo()[c]; }
    Vector emitted(int c) const { return emitted_.row(c).transpose(); }
    // b = K Le, by light sampling if the rays of T hardly hit the lights.
    Vector direct(int c) const { return direct_.row(c).transpose(); }
    bool samples_lights() const { return samples_lights_; }

    std::size_t rays() const { return table_.seen().size(); }
    std::size_t rays_that_see_nothing() const;

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
