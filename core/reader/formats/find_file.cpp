#include "core/reader/formats/find_file.h"

#include "core/reader/meshes/mesh_text.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace neumann::reader {

namespace fs = std::filesystem;

std::string with_slashes(std::string path) {
    std::replace(path.begin(), path.end(), '\\', '/');
    return path;
}

std::string stem_of(const std::string& path) { return fs::path(path).stem().string(); }

std::string find_file(const std::string& name, const std::string& main_file, const Location& place) {
    const fs::path folder = fs::path(main_file).parent_path(), beside = fs::path(place.file).parent_path();
    for (const std::string& spelt : {name, with_slashes(name)})
        for (const fs::path& from : {folder, beside}) {
            const fs::path path = from / spelt;  // an absolute name stays as it is
            std::error_code error;
            if (!spelt.empty() && spelt.find('\0') == std::string::npos && fs::exists(path, error) &&
                !fs::is_directory(path, error))
                return path.string();
        }
    const auto shown = [](const fs::path& f) { return f.empty() ? std::string(".") : f.string(); };
    throw InputError(place, fmt::format("there is no file '{}'; looked in: {}{}", printable(name), shown(folder),
                                        beside == folder ? "" : ", " + shown(beside)));
}

std::string name_for_elements(const std::string& path, const std::string& main_file) {
    const fs::path folder = fs::path(main_file).parent_path(), file = path;
    if (folder.empty() || file.is_absolute() != folder.is_absolute()) return path;
    const std::string name = file.lexically_relative(folder).generic_string();
    return name.empty() || name.starts_with("..") ? path : name;
}

}  // namespace neumann::reader
