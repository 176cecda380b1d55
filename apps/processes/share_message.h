// Samples of a share as bytes, for another process of the same program: numbers as they are in memory.
#pragma once

#include "operators/render/from_paths/share.h"

#include <cstddef>
#include <span>
#include <vector>

namespace neumann {

std::vector<std::byte> as_bytes(const SampledShare& sampled);
SampledShare sampled_share_from(std::span<const std::byte> bytes);

}  // namespace neumann
