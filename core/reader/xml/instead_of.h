// Plugins of Mitsuba that are not read, and what can be taken in their place.
#pragma once

#include <string_view>

namespace neumann::reader {

// Such as "hair is not simulated", or "" for what Mitsuba does not have, either. `tag`: of the element, such as "bsdf"; `type`: ""
// for an element that no type of is read.
std::string_view instead_of(std::string_view tag, std::string_view type);

}  // namespace neumann::reader
