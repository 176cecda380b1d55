// Refuses more patches than memory holds, before anything is built, and says how many would fit.
#pragma once

#include "core/base/memory.h"

#include <cstddef>
#include <cstdint>

namespace neumann {

// `bytes_of_patch`: about what all that is kept needs for one; `rays`: of a facet, for the message; `memory`: bytes that may be
// taken. Throws InputError.
void check_patch_memory(std::size_t patches, std::uint64_t rays, double bytes_of_patch, double memory = default_memory());

}  // namespace neumann
