// A few thousand walks before the render, which estimate how long walks are, how fast the terms fall, and whether the series
// converges. Their random numbers are independent of the render's, so choices based on the pilot do not bias the render.
#pragma once

#include "core/scene/scene.h"
#include "operators/paths/walk/walk_settings.h"
#include "operators/statistics/picture_statistics.h"

#include <span>
#include <vector>

namespace neumann {

class Pilot {
public:
    // The number of terms estimated one by one: few if the rest beyond them is small, and otherwise most. A walk is
    // given up after `give_up` further bounces.
    static constexpr int few_bounces = 64, most_bounces = 256, give_up = 10'000;

    // By default, N is large enough that the rest is below this part of the sum.
    static constexpr double default_tail = 0.01;

    // `wanted`: N, if it is given; `tail`: otherwise the part of the sum that may be beyond N.
    Pilot(const Scene& scene, const DirectLightSettings& direct, std::uint64_t seed, int wanted = 0, double tail = default_tail);

    int bounces() const { return static_cast<int>(term_.size()) - 2; }
    // The mean of K^i Le over channels and film, i ≤ bounces(). Walks start uniformly on the film, whatever its filter.
    MeanWithError term(int i) const;
    // Σ_{k>i} K^k Le, likewise.
    MeanWithError rest(int i) const;
    double sum() const { return rest_[0].mean + term_[0].mean; }

    // False if more than 1 in 20 walks were given up: the series does not converge, or too slowly to tell.
    bool converges() const { return given_up_ * 20 <= walks_; }
    std::uint64_t walks() const { return walks_; }
    std::uint64_t given_up() const { return given_up_; }

    // The smallest N ≤ bounces() whose rest, with twice its standard error, is below `fraction` of the sum; −1 if there is none.
    int bounces_for_tail(double fraction) const;
    // The probability of going on into the rest beyond N, or beyond bounces() if that is less, with which the rest takes no more
    // rays than the terms.
    double rest_probability(int N) const;
    // The rays of a walk for each term 0 … bounces(), and for the rest beyond.
    std::span<const double> rays() const { return rays_; }
    // The time, using all threads, of a ray with the work at its end, and of a walk up to bounce N.
    double seconds_per_ray() const { return seconds_per_ray_; }
    double seconds_per_walk(int N) const;

private:
    struct Walks;
    void take(const Walks& walks);
    double upper_rest(int i) const;  // with twice its standard error

    std::vector<MeanWithError> term_, rest_;
    std::vector<double> rays_;
    std::uint64_t walks_ = 0, given_up_ = 0;
    double seconds_per_ray_ = 0.0;
};

// The number of pilots that this program has run so far.
std::uint64_t pilots_run();

}  // namespace neumann
