// The numbers of some facets, or all facets if there is no value.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace neumann {

using SomeFacets = std::optional<std::span<const std::uint32_t>>;

}  // namespace neumann
