// The samples of every term, for several walks.
#pragma once

#include "core/base/vec.h"

#include <cstdint>
#include <span>

namespace neumann {

// `quantities` has N + 2 entries for each walk: the terms 0 … N and the rest.
struct TermSamples {
    std::span<Rgb> quantities;      // samples are added to it
    std::span<std::uint64_t> rays;  // N + 2 entries, to which the rays that all walks cast for each are added
    std::uint64_t given_up = 0;     // number of walks, which is added to
};

}  // namespace neumann
