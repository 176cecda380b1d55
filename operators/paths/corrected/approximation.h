// The start of corrected terms: approximate fields f_k ≈ K^k Le on diffuse sides, and the density with which points are
// drawn there. Any fields and any density above 0 leave the terms unbiased; better ones leave less to correct.
#pragma once

#include "core/base/memory.h"
#include "operators/paths/corrected/field_raster.h"
#include "operators/paths/guided/direction_tables.h"
#include "operators/watch.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace neumann {

struct ApproximationSettings {
    std::size_t patches = 1000;  // approximate number
    std::uint32_t rays = 64;     // per side of a patch; a power of two
    int bounces = 8;             // N
    std::uint64_t seed = 0;      // independent of the samples' random numbers with the same seed
    double memory = default_memory();
};

class Approximation {
public:
    // Keeps a reference to the scene. Throws InputError if the fields do not fit in memory, and Stopped if `watch` stops it.
    Approximation(const Scene& scene, const ApproximationSettings& settings, const Watch& watch = {});
    Approximation(const Approximation&) = delete;

    const ApproximationSettings& settings() const { return settings_; }
    // Null if no side is diffuse.
    const FieldRaster* fields() const { return fields_ ? &*fields_ : nullptr; }
    // Null if no side is diffuse.
    const DirectionTables* tables() const { return tables_ ? &*tables_ : nullptr; }
    double area() const { return area_; }  // of the sides with fields, scene units squared
    std::uint64_t rays() const { return rays_; }

    struct Draw {
        SurfacePoint point;
        Vec3 normal;             // of its side
        double inverse_density;  // scene units squared
    };
    // Draws a point: `choice` chooses the patch, in the order of patches, and u the place on it.
    Draw draw(double choice, const Vec2& u) const;

private:
    void find_density(const DiffuseSides& sides, const FieldStack& fields);

    ApproximationSettings settings_;
    std::optional<Scene> diffuse_scene_;
    std::optional<PatchSpace> space_;
    std::optional<FieldRaster> fields_;
    std::optional<DirectionTables> tables_;
    std::vector<std::uint32_t> facets_;  // on diffuse sides
    std::vector<double> ends_;           // cumulative probability of facets_
    double area_ = 0.0;
    std::uint64_t rays_ = 0;
};

}  // namespace neumann
