// Russian roulette (Arvo and Kirk 1990): ends walks at random and divides the weight of the others by their survival probability.
// It is unbiased for any probability above 0, but the variance is finite only if Σ E[β²] converges. In a furnace of albedo ρ this
// means ρ² < survival.
#pragma once

#include "core/base/vec.h"

#include <algorithm>

namespace neumann {

struct Roulette {
    enum class Kind {
        none,       // no roulette up to bounce N; in the rest, survive with the ratio of β to its value at the last survival
        fixed,      // survive with probability `survival`
        albedo,     // survive with the weight of the last reflection
        throughput  // survive with β
    };
    Kind kind = Kind::none;
    double survival = 1.0;  // used by `fixed`

    bool operator==(const Roulette&) const = default;

    // The probability of surviving. Weights are largest channels: `reflected` is that of the last reflection, `beta`
    // that of the walk, and `kept` that of the walk when it last survived. `rest` means that the bounce is beyond N.
    double probability(bool rest, double reflected, double beta, double kept) const {
        switch (kind) {
            case Kind::none:
                return rest ? std::min(beta / kept, 1.0) : 1.0;
            case Kind::fixed:
                return survival;
            case Kind::albedo:
                return std::min(reflected, 1.0);
            case Kind::throughput:
                return std::min(beta, 1.0);
        }
        return 1.0;
    }
};

}  // namespace neumann
