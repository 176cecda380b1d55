// Numbers of facets, or all if there are none.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace neumann {

using SomeFacets = std::optional<std::span<const std::uint32_t>>;

}  // namespace neumann
