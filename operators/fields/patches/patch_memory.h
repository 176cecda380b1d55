#pragma once

#include "core/base/memory.h"

#include <cstddef>
#include <cstdint>

namespace neumann {

// Throws InputError before anything is built if the patches do not fit in memory, and says how many would fit. `bytes_of_patch` is
// the approximate memory per patch, everything included; `rays`, per facet, is for the message; `memory` is the limit in bytes.
void check_patch_memory(std::size_t patches, std::uint64_t rays, double bytes_of_patch, double memory = default_memory());

}  // namespace neumann
