// A reason, in words, not to trust unbounced pictures.
#pragma once

#include "operators/experiments/unbounce/agreement.h"

#include <string>
#include <vector>

namespace neumann {

struct Doubt {
    enum class Kind {
        singular,       // a singular matrix lies within the errors of the pictures
        noise,          // the error of a term is more than half of it
        negative,       // negative light
        gain,           // a region reflects more than it receives
        idle_light,     // a light lights nothing that is visible
        foreign_light,  // a region is brighter under another light than under its own
        shared_light,   // a light shines directly on the regions of others
        unlit,          // no light shines directly on some pixels
        unseen,         // light comes by way of surfaces that are not seen
        differs         // the result differs from the forward series
    };
    Kind kind;
    std::string words;
};

// "singular", "negative", …
const char* name_of(Doubt::Kind kind);

// All doubts. `names`: of the lights. Doubts about numbers are significant beyond errors: about negative light, gains
// and differences, one set of pictures in a few hundred raises one by chance. If errors are not known, light of 1% of
// the largest of its kind counts.
std::vector<Doubt> doubts_about(const Unbounced& found, const std::vector<std::string>& names,
                                const std::vector<TermAgreement>& forward = {});

}  // namespace neumann
