#include "core/base/printable.h"

namespace neumann {

std::string printable(std::string_view text, std::size_t longest) {
    std::string result(text.substr(0, longest));
    for (char& c : result) {
        if (c < ' ' || c > '~') c = '?';
    }
    if (text.size() > longest) result += "...";
    return result;
}

std::string glimpse_of(std::string_view text) { return printable(text, 12); }

std::string with_article(std::string_view noun) {
    const bool has_an = noun == "rgb" || noun.find_first_of("aeiou") == 0;
    return (has_an ? "an " : "a ") + std::string(noun);
}

}  // namespace neumann
