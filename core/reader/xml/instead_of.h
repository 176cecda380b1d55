// Plugins of Mitsuba that are not read, and what can be taken in their place.
#pragma once

#include <string_view>

namespace neumann::reader {

// "sky and sun as a picture: …", or "" for what Mitsuba does not have, either. `tag`: of the element, such as "bsdf".
std::string_view instead_of(std::string_view tag, std::string_view type);

}  // namespace neumann::reader
