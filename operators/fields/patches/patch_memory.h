// Throws an error before anything is built if the patches do not fit in memory, and says how many would fit.
#pragma once

#include "core/base/memory.h"

#include <cstddef>
#include <cstdint>

namespace neumann {

// `bytes_of_patch`: approximate memory per patch, everything included; `rays`: per facet, for the message; `memory`: the limit in
// bytes. Throws InputError.
void check_patch_memory(std::size_t patches, std::uint64_t rays, double bytes_of_patch, double memory = default_memory());

}  // namespace neumann
