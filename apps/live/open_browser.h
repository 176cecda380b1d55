#pragma once

#include <string>

namespace neumann {

// Opens an address in the user's browser, if there is a display. Returns whether a browser was started.
bool open_browser(const std::string& address);

}  // namespace neumann
