// Ends walks by chance and gives those that go on the reciprocal weight (Arvo and Kirk 1990): unbiased for any probability above 0,
// but of finite variance only where the squares of what is left, Σ E[β²], converge. In a furnace of albedo ρ that is ρ² < survival.
#pragma once

#include "core/base/vec.h"

#include <algorithm>

namespace neumann {

struct Roulette {
    enum class Kind {
        none,       // no walk ends before the last picture; beyond it those that have lost weight since then do
        fixed,      // always the same
        albedo,     // by what the last reflection has left of the weight
        throughput  // by the weight that is left of all reflections
    };
    Kind kind = Kind::none;
    double survival = 1.0;  // of `fixed`

    bool operator==(const Roulette&) const = default;

    // Of going on, largest channels counting. `reflected`: the weight of the last reflection; `beta`: of the walk; `kept`: of the
    // walk when it last went on. `rest`: beyond the last picture.
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
