// The balance of energy, bounce by bounce: the energy that arrives at a surface is absorbed there, leaves the scene
// after the reflection, or goes on to the next surface. The energy of a camera path is its throughput β, which is 1 at
// the camera; that of a path from a light is its power.
//
//     E β_i = E β_i (1 − ρ(x_i, ω_i)) + E β_{i+1} [nothing is hit] + E β_{i+1} [something is hit],   ρ = ∫ fs |cosθ| dω
//
// ρ is estimated with independent directions and from fs itself, not from the weights of sampled directions, so the two
// sides differ if the weights of a material, a guide or roulette are wrong. (A sampling density that differs from the
// pdf is not noticed if the mean weight stays the same.) Delta lobes have no value of fs; their sampled weight is used.
#pragma once

#include "core/sampling/sampler.h"
#include "core/scene/scene.h"
#include "operators/paths/walk/path_observer.h"
#include "operators/statistics/picture_statistics.h"

#include <vector>

namespace neumann {

// The mean energies of one bounce, over paths and channels.
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
    std::vector<BalanceOfBounce> bounces;  // from bounce 1 on
    // Whether the imbalance of a bounce differs from 0, with 99.99% confidence for all bounces together (Student's t, Bonferroni).
    bool is_sick(std::size_t bounce) const;
    bool is_sick() const;
    static constexpr double confidence = 0.9999;
};

// The balance of paths that are traced together; add() takes their rays in order.
class BalanceSheet {
public:
    // `walks`: the number of walks that go on from each first vertex.
    BalanceSheet(const Scene& scene, bool from_light, int bounces, int walks, std::uint64_t seed, std::uint32_t stream);

    void add(std::uint32_t path, const PathStep& step);
    // Must be called after the last ray: turns sums into means over `paths` paths.
    void finish(std::uint32_t paths);

    // Entry 0 is the energy that started, and the part that left without hitting a surface; entries 1 … are bounces.
    const std::vector<EnergyShares>& shares() const { return entries_; }

private:
    void settle(std::uint32_t path);
    void arrive(int bounce, const SurfacePoint& x, const Vec3& w, const Rgb& beta);
    Rgb albedo(const SurfacePoint& x, const Vec3& w);

    const Scene* scene_;
    bool from_light_;
    double share_;
    Sampler random_;
    // The last first ray of each path: one that passes a hidden light is followed by another.
    std::vector<PathStep> first_;
    std::vector<char> waiting_;
    std::vector<EnergyShares> entries_;
};

// Combines independent observations, each from BalanceSheet::shares(), into means with standard errors.
EnergyBalance balance(const std::vector<std::vector<EnergyShares>>& observations);

}  // namespace neumann
