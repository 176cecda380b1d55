// Why what was unbounced is not to be trusted, in words.
#pragma once

#include "operators/experiments/unbounce/agreement.h"

#include <string>
#include <vector>

namespace neumann {

struct Doubt {
    enum class Kind {
        singular,       // a singular matrix lies within the errors of the pictures
        noise,          // a term's error is more than half of it
        negative,       // negative light
        gain,           // a region gives back more than it receives
        idle_light,     // a light lights nothing that is seen
        foreign_light,  // a region is brighter under another light than under its own
        shared_light,   // a light shines directly on the regions of others
        unlit,          // pixels that no light shines on directly
        unseen,         // light comes by way of surfaces that are not seen
        differs         // from the forward series
    };
    Kind kind;
    std::string words;
};

// "singular", "negative", …
const char* name_of(Doubt::Kind kind);

// `names`: of the lights. Doubts about numbers are beyond errors: of negative light, of gains, and of differences, one pile of
// pictures in a few hundred raises one by chance. Where errors are not known, light of 1% of the largest of its kind counts.
std::vector<Doubt> doubts_about(const Unbounced& found, const std::vector<std::string>& names,
                                const std::vector<TermAgreement>& forward = {});

}  // namespace neumann
