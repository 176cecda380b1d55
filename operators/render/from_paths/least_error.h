// The error that the distribution of a picture's samples makes least.
#pragma once

#include <optional>

namespace neumann {

struct LeastError {
    enum class Of { bounces, sum, all } of;
    std::optional<int> bounce = {};  // the only one that counts among the bounces

    // The largest relative error of a bounce.
    static const LeastError of_bounces;
    // The relative error of the sum of all bounces.
    static const LeastError of_sum;
    // All of these together, so that none is bought with much of another.
    static const LeastError of_all;
    // That of a single bounce, the n-th.
    static constexpr LeastError of_bounce(int n) { return {Of::bounces, n}; }

    bool operator==(const LeastError&) const = default;
};

inline constexpr LeastError LeastError::of_bounces{LeastError::Of::bounces};
inline constexpr LeastError LeastError::of_sum{LeastError::Of::sum};
inline constexpr LeastError LeastError::of_all{LeastError::Of::all};

}  // namespace neumann
