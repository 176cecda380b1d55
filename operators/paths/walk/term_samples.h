// Samples of every term, for several walks.
#pragma once

#include "core/base/vec.h"

#include <cstdint>
#include <span>

namespace neumann {

// `quantities` has N + 2 entries for each walk: the terms 0 … N and the rest.
struct TermSamples {
    std::span<Rgb> quantities;      // added to
    std::span<std::uint64_t> rays;  // N + 2 entries: rays cast for each, by all walks; added to
    std::uint64_t given_up = 0;     // number of walks; added to
};

}  // namespace neumann
