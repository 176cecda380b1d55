// Texts from files, fit for messages.
#pragma once

#include <string>
#include <string_view>

namespace neumann {

// Printable ASCII and not too long.
std::string printable(std::string_view text, std::size_t longest = 40);
// What stands where something else is expected, a few characters: a file that is none of ours may be anyone's, and is not copied
// into messages.
std::string glimpse_of(std::string_view text);

// "a bitmap", "an integer", "an rgb".
std::string with_article(std::string_view noun);

}  // namespace neumann
