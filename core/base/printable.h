// Makes texts from files fit for messages.
#pragma once

#include <string>
#include <string_view>

namespace neumann {

// The text as printable ASCII, cut to a length.
std::string printable(std::string_view text, std::size_t longest = 40);
// A few characters of a text where something else is expected: a file of an unknown kind may be anyone's, so it is not
// copied into messages.
std::string glimpse_of(std::string_view text);

// The noun with its article: "a bitmap", "an integer", "an rgb".
std::string with_article(std::string_view noun);

}  // namespace neumann
