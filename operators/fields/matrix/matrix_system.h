// A scene as matrices, for `solve` and `spectrum`. Either one process has all of it (traced_system.h), or several share
// it (operators/fields/shared/shared_system.h), and then vectors hold the values of a process's own unknowns.
#pragma once

#include "core/base/memory.h"
#include "core/scene/scene.h"
#include "operators/fields/matrix/kept_rows.h"
#include "operators/fields/patches/patch_space.h"
#include "operators/solvers/spectrum/spectrum.h"

#include <cstdint>
#include <memory>

namespace neumann {

struct TracedSettings {
    std::size_t patches = 2000;  // approximate number; at least one per chart
    std::uint32_t rays = 64;     // per facet; a power of two. Also the number of light samples per facet
    std::uint64_t seed = 0;
    double memory = default_memory();  // approximate limit in bytes
    RowStore* store = nullptr;         // keeps the rows of T while it is traced; null if they are not kept

    std::unique_ptr<KeptRows> kept() const { return store ? store->rows_of(*this) : nullptr; }
};

class MatrixSystem {
public:
    virtual ~MatrixSystem() = default;

    virtual const Scene& scene() const = 0;
    virtual const TracedSettings& settings() const = 0;
    virtual const PatchSpace& space() const = 0;
    virtual std::size_t rays() const = 0;
    virtual std::size_t rays_that_see_nothing() const = 0;
    virtual bool samples_lights() const = 0;
    // The same scene with other settings. Throws as the constructors do.
    virtual std::unique_ptr<MatrixSystem> with(const TracedSettings& settings, const Watch& watch) const = 0;

    // 1 if the scene is grey, otherwise 3.
    virtual int channels() const = 0;
    // "grey", or "red", "green", "blue".
    const char* channel_name(int c) const {
        constexpr const char* names[] = {"red", "green", "blue"};
        return channels() == 1 ? "grey" : names[c];
    }
    // Largest albedo for basic radiance.
    double largest_albedo(int c) const { return scene().materials.largest_basic_albedo()[c]; }
    virtual Vector emitted(int c) const = 0;
    // b = K Le, by light sampling if the rays of T hardly hit the lights.
    virtual Vector direct(int c) const = 0;

    // reflected() is K of a channel. transported() is T alone: a row of T is the mean over its rays, so T 1 = 1 in a
    // closed scene. Both refer to this object.
    virtual std::unique_ptr<ChannelOperator> reflected(int c) const = 0;
    virtual std::unique_ptr<ChannelOperator> transported() const = 0;
    virtual OperatorNorms norms(const ChannelOperator& K, const EigenLimits& limits) const = 0;
    virtual Eigenpairs leading(const ChannelOperator& K, int count, const EigenLimits& limits) const = 0;
    // `error` is the standard error of (K* 1)_u for the unknown u = OperatorNorms::one_at, estimated by the rays that
    // hit it, and `part` is u's part of the whole measure.
    struct PowerError {
        double error = 0.0, part = 0.0;
    };
    virtual PowerError error_of_power(int c, Eigen::Index one_at) const = 0;
};

}  // namespace neumann
