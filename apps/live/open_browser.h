#pragma once

#include <string>

namespace neumann {

// Opens an address in the user's browser, where there is a display. Returns whether one was asked to.
bool open_browser(const std::string& address);

}  // namespace neumann
