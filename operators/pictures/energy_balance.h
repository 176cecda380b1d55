// Where the energy goes, bounce by bounce: what arrives at a surface is absorbed there, leaves the scene after the reflection, or
// goes on to the next surface. Of camera paths it is their weight β, 1 at the camera; of paths from the lights, their power.
//
//     E β_i = E β_i (1 − ρ(x_i, ω_i)) + E β_{i+1} [nothing is hit] + E β_{i+1} [something is hit],   ρ = ∫ fs |cosθ| dω
//
// ρ is estimated by other directions than those of the path, from fs itself and not from the weights of sampled directions, so
// that the two sides differ where weights are wrong: of a material, a guide, roulette. (Directions that are drawn with another
// density than their weight supposes are not told where the weight's mean stays the same.) What is a delta in fs has no value but
// the sampled one, and counts as that.
#pragma once

#include "core/sampling/independent_sampler.h"
#include "core/scene/scene.h"
#include "operators/pictures/path_observer.h"
#include "operators/statistics/picture_statistics.h"

#include <vector>

namespace neumann {

// Means over paths, of the mean of the channels.
struct BalanceOfBounce {
    MeanWithError arrived, absorbed, left, went_on;
    MeanWithError imbalance;  // arrived − absorbed − left − went_on, which is 0 but for chance
};

// What is found of one bounce by one of several observations.
struct EnergyShares {
    double arrived = 0.0, absorbed = 0.0, left = 0.0, went_on = 0.0;
};

struct EnergyBalance {
    MeanWithError begun, left;             // what set out, and what of it left the scene before any surface
    std::vector<BalanceOfBounce> bounces;  // 1 …
    // That of a bounce is not 0, with 99.99% confidence for all of them together (Student's t, Bonferroni).
    bool is_sick(std::size_t bounce) const;
    bool is_sick() const;
    static constexpr double confidence = 0.9999;
};

// Of some paths that are traced together; told of their rays in order.
class BalanceSheet {
public:
    // `walks`: so many go on from each first vertex.
    BalanceSheet(const Scene& scene, bool from_light, int bounces, int walks, std::uint64_t seed, std::uint32_t stream);

    void add(std::uint32_t path, const PathStep& step);
    // After the last ray of `paths` paths: means over them.
    void finish(std::uint32_t paths);

    // 0: what set out, and left before any surface; 1 … are bounces.
    const std::vector<EnergyShares>& shares() const { return entries_; }

private:
    void settle(std::uint32_t path);
    void arrive(int bounce, const SurfacePoint& x, const Vec3& w, const Rgb& beta);
    Rgb albedo(const SurfacePoint& x, const Vec3& w);

    const Scene* scene_;
    bool from_light_;
    double share_;
    IndependentSampler random_;
    std::vector<PathStep> first_;  // of each path, until it is known to be the last one that lights let pass
    std::vector<char> waiting_;
    std::vector<EnergyShares> entries_;
};

// Of observations that are independent of each other, each as BalanceSheet::shares().
EnergyBalance balance(const std::vector<std::vector<EnergyShares>>& observations);

}  // namespace neumann
