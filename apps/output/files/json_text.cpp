#include "apps/output/files/json_text.h"

#include <filesystem>
#include <optional>

namespace neumann {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view replacement = "\xef\xbf\xbd";

// The only entry of a folder that json_text() writes as `name`.
std::optional<fs::path> entry_written_as(const fs::path& folder, const std::string& name) {
    std::optional<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator it(folder.empty() ? "." : folder, error); !error && it != fs::directory_iterator();
         it.increment(error)) {
        const fs::path entry = it->path().filename();
        if (json_text(entry.string()) != json_text(name)) continue;
        if (found) return std::nullopt;
        found = folder / entry;
    }
    return found;
}

}  // namespace

std::string file_named_in_json(const std::string& name) {
    if (name.find(replacement) == std::string::npos) return name;
    fs::path found;
    for (const fs::path& part : fs::path(name)) {
        std::error_code error;
        const bool is_there = fs::exists(found / part, error);
        const std::optional<fs::path> entry = is_there ? found / part : entry_written_as(found, part.string());
        if (!entry) return name;
        found = *entry;
    }
    return found.string();
}

}  // namespace neumann
