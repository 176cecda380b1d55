// Where the energy goes, bounce by bounce: what arrives at a surface is absorbed there, leaves the scene after the reflection, or
// goes on to the next surface. The energy of a camera path is its throughput β, which is 1 at the camera; that of a path from a
// light is its power.
//
//     E β_i = E β_i (1 − ρ(x_i, ω_i)) + E β_{i+1} [nothing is hit] + E β_{i+1} [something is hit],   ρ = ∫ fs |cosθ| dω
//
// ρ is estimated with independent directions and from fs itself, not from the weights of sampled directions, so the two sides
// differ if the weights of a material, a guide or roulette are wrong. (A sampling density that differs from the pdf is not noticed
// if the mean weight stays the same.) Delta lobes have no value of fs; their sampled weight is used.
#pragma once

#include "core/sampling/sampler.h"
#include "core/scene/scene.h"
#include "operators/paths/walk/path_observer.h"
#include "operators/statistics/picture_statistics.h"

#include <vector>

namespace neumann {

// Means over paths, of the mean of the channels.
struct BalanceOfBounce {
    MeanWithError arrived, absorbed, left, went_on;
    MeanWithError imbalance;  // arrived − absorbed − left − went_on; its expectation is 0
};

// The energies of one bounce in one of several independent observations.
struct EnergyShares {
    double arrived = 0.0, absorbed = 0.0, left = 0.0, went_on = 0.0;
};

struct EnergyBalance {
    MeanWithError begun, left;             // energy at the start, and the part that left the scene without hitting a surface
    std::vector<BalanceOfBounce> bounces;  // 1 …
    // Whether the imbalance of a bounce differs from 0, with 99.99% confidence for all bounces together (Student's t, Bonferroni).
    bool is_sick(std::size_t bounce) const;
    bool is_sick() const;
    static constexpr double confidence = 0.9999;
};

// The balance of paths that are traced together; add() takes their rays in order.
class BalanceSheet {
public:
    // `walks`: number of walks that go on from each first vertex.
    BalanceSheet(const Scene& scene, bool from_light, int bounces, int walks, std::uint64_t seed, std::uint32_t stream);

    void add(std::uint32_t path, const PathStep& step);
    // Call after the last ray: turns sums into means over `paths` paths.
    void finish(std::uint32_t paths);

    // Entry 0: what started, and what left without hitting a surface; entries 1 … are bounces.
    const std::vector<EnergyShares>& shares() const { return entries_; }

private:
    void settle(std::uint32_t path);
    void arrive(int bounce, const SurfacePoint& x, const Vec3& w, const Rgb& beta);
    Rgb albedo(const SurfacePoint& x, const Vec3& w);

    const Scene* scene_;
    bool from_light_;
    double share_;
    Sampler random_;
    std::vector<PathStep> first_;  // the first ray of each path, kept until no hidden light in front lets a further one pass
    std::vector<char> waiting_;
    std::vector<EnergyShares> entries_;
};

// Combines independent observations, each from BalanceSheet::shares(), into means with standard errors.
EnergyBalance balance(const std::vector<std::vector<EnergyShares>>& observations);

}  // namespace neumann
