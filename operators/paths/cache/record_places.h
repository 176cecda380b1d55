// The places of the records of an irradiance cache, and the radii within which they are read. The places are chosen
// once, before the first sample: all passes fill the same ones, so that their spread is that of the samples alone.
//
// A record at x is read at y with normal n if e < 1, with the weight 1 − e (after Ward and others, 1988):
//
//     e = |y − x| / r + √(1 − n·n_x) / s
//
// It gives E + (n·t) ∂E/∂n + (y − x)·∂E/∂x (hemisphere_cells.h). Its radius r depends on the harmonic mean R of the
// distances of the surfaces that it sees, on the second derivatives H of E along the surface, whose eigenvalues are λ,
// and on the radius ℓ of the disk that is usual in the scene:
//
//     split-sphere: r = a R,  s = a
//     Hessian:      r⁴ = 8 a ℓ² E / (|λ1| + |λ2|), so that (1/π r²) ∫ ½ uᵀHu ≤ a E if r = ℓ, and in proportion to r²
//                   otherwise, which gives the least sum of errors for the number of records
//
// The latter is at most R/2, and both are at most E / |∂E/∂x|, because beyond that the record could give less than 0.
#pragma once

#include "core/base/frame.h"
#include "core/sampling/sampler.h"
#include "core/scene/scene.h"
#include "operators/paths/cache/cache_settings.h"
#include "operators/paths/cache/hemisphere_cells.h"
#include "operators/watch.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace neumann {

struct Record {
    SurfacePoint x;
    Frame frame;  // z: the shading normal on the side that reflects
    double radius = 0.0;
    bool is_seen = false;  // whether the camera sees it; the camera reads no others
};

class RecordPlaces {
public:
    // Keeps a reference to the scene. The places are the same for the same scene and seed, on any number of threads,
    // however many bounces are rendered. Throws InputError if paths from the camera meet no diffuse surface, or if the
    // rays of all records take more than `memory` bytes; and Stopped if `watch` stops it.
    RecordPlaces(const Scene& scene, const CacheSettings& settings, SamplerKind sampler, std::uint64_t seed, double memory,
                 const Watch& watch = {});
    ~RecordPlaces();

    const CacheSettings& settings() const { return settings_; }
    const HemisphereCells& cells() const { return cells_; }
    const std::vector<Record>& records() const { return records_; }
    std::size_t seen() const { return seen_; }  // the number of records that the camera reads
    double disk() const { return disk_; }       // ℓ
    std::uint64_t rays() const { return rays_; }

    struct NearRecord {
        std::uint32_t record;
        float error;                  // e
        std::array<float, 4> offset;  // n and y − x along x and y of the record's frame
    };
    // Finds the records with e < `most` at y, in an order that depends only on the records and y. Overwrites `near`.
    void find(const Vec3& y, const Vec3& n, bool only_seen, double most, std::vector<NearRecord>& near) const;

private:
    class Index;
    struct Vertex;
    class Placer;

    CacheSettings settings_;
    HemisphereCells cells_;
    std::vector<Record> records_;
    std::unique_ptr<Index> index_;
    std::size_t seen_ = 0;
    double disk_ = 0.0, turning_;  // s
    std::uint64_t rays_ = 0;
};

}  // namespace neumann
