#include "apps/requests/chosen_pixels.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <charconv>

namespace neumann {

ChosenPixels choose_pixels(const std::vector<std::string>& texts, const ChosenFiles& files) {
    ChosenPixels chosen;
    for (const std::string& text : texts) {
        if (text == "named") {
            chosen.named = true;
            continue;
        }
        const char* const end = text.data() + text.size();
        int x = 0, y = 0;
        const auto [comma, no_x] = std::from_chars(text.data(), end, x);
        const bool has_comma = no_x == std::errc() && comma != end && *comma == ',';
        const auto [rest, no_y] = has_comma ? std::from_chars(comma + 1, end, y) : std::from_chars_result{comma, no_x};
        if (!has_comma || no_y != std::errc() || rest != end)
            throw OptionError("paths", fmt::format("{}: expected a pixel, as 19,160, or the word named", text));
        chosen.pixels.emplace_back(x, y);
    }
    if (!chosen.empty() && !files.page) throw OptionError("paths", ": are for the page; expected page among --files");
    return chosen;
}

}  // namespace neumann
