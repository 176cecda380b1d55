// The seed of the statistical tests: the same every day, or what NEUMANN_TEST_SEED says, to run them over many.
#pragma once

#include "operators/experiments/known/probe.h"

#include <cstdint>
#include <cstdlib>

namespace neumann::physics {

inline std::uint64_t chosen_seed() {
    const char* text = std::getenv("NEUMANN_TEST_SEED");
    return text ? std::strtoull(text, nullptr, 10) : 20240229;
}
inline const std::uint64_t fixed_seed = known::default_seed = chosen_seed();

}  // namespace neumann::physics
