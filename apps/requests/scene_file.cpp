#include "apps/requests/scene_file.h"

#include "core/base/error.h"
#include "core/reader/read_scene.h"

#include <dlfcn.h>
#include <filesystem>

namespace neumann {

Scene read_scene(const SceneFile& file) { return read_scene(file.path, file.definitions, {.lenient = file.lenient}); }

std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& texts) {
    std::map<std::string, std::string> definitions;
    for (const std::string& text : texts) {
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0) throw InputError("-D " + text + ": expected name=value");
        if (!definitions.emplace(text.substr(0, equals), text.substr(equals + 1)).second)
            throw InputError("-D " + text + ": '" + text.substr(0, equals) + "' is given twice");
    }
    return definitions;
}

namespace {

namespace fs = std::filesystem;

// The file that contains this code: the program, or Python's module.
fs::path own_file() {
    std::error_code error;
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(&scene_along), &info) != 0 && fs::path(info.dli_fname).extension() == ".so")
        return fs::canonical(info.dli_fname, error);
    return fs::read_symlink("/proc/self/exe", error);
}

}  // namespace

std::string scene_along(const std::string& name) {
    std::error_code error;
    if (name.empty() || name.find_first_of("/.") != std::string::npos || fs::exists(name, error)) return name;
    // The own file is installed as bin/neumann or lib/python3/dist-packages/neumann/, and built as
    // build/release/apps/neumann or build/release/python/neumann/.
    fs::path folder = own_file().parent_path();
    for (int up = 0; up <= 4 && !folder.empty(); ++up, folder = folder.parent_path())
        for (const char* scenes : {"share/neumann/scenes", "scenes"}) {
            const fs::path file = folder / scenes / name / (name + ".xml");
            if (fs::exists(file, error)) return file.string();
        }
    return name;
}

}  // namespace neumann
