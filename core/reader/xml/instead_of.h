// Plugins of Mitsuba that are not read, and what can be taken in their place.
#pragma once

#include <string_view>

namespace neumann::reader {

// A text such as "hair is not simulated", or "" for what Mitsuba does not have, either. `tag` is that of the element,
// such as "bsdf"; `type` is "" for an element of which no type is read.
std::string_view instead_of(std::string_view tag, std::string_view type);

}  // namespace neumann::reader
