#include "core/reader/formats/json_file.h"

#include "core/base/input_file.h"
#include "core/base/printable.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

Location place_in(const std::string& path, std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const std::size_t line_start = before.rfind('\n') + 1;  // 0 where there is none
    return {path, static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
            static_cast<int>(before.size() - line_start) + 1};
}

// The message of the JSON library without the library's name and the place, which begin it.
std::string reason(const std::exception& e) {
    const std::string_view what = e.what(), mark = ": ";
    const std::size_t at = what.find(mark);
    constexpr std::size_t longest = 120;  // the message quotes the text read last
    return printable(at == std::string_view::npos ? what : what.substr(at + mark.size()), longest);
}

}  // namespace

nlohmann::json parse_json(const std::string& path, std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    try {
        return nlohmann::json::parse(text.begin(), text.end());
    } catch (const nlohmann::json::parse_error& e) {
        throw InputError(place_in(path, text, e.byte > 0 ? e.byte - 1 : 0), "broken JSON: " + reason(e));
    } catch (const nlohmann::json::exception& e) {
        throw InputError(Location{path}, fmt::format("broken JSON: {}", e.what()));
    }
}

std::string read_bytes(const std::string& path, const Location& place) {
    const std::string expected = place.pointer.empty() ? "a scene file" : "a file";
    if (const auto why = why_not_input(path, expected)) {
        // The place names the scene file already.
        if (place.pointer.empty()) throw InputError(place, *why);
        std::error_code error;
        if (!std::filesystem::exists(path, error)) throw InputError(place, fmt::format("there is no file '{}'", path));
        throw InputError(place, fmt::format("'{}' {}", path, *why));
    }
    return read_input(path, expected);
}

}  // namespace neumann::reader
