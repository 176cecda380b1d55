#include "apps/command_line/scenes_along.h"

#include <filesystem>

namespace neumann {

std::string scene_along(const std::string& name) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (name.empty() || name.find_first_of("/.") != std::string::npos || fs::exists(name, error)) return name;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    for (const char* scenes : {"../share/neumann/scenes", "../../../scenes"}) {
        const fs::path file = (program.parent_path() / scenes / name / (name + ".xml")).lexically_normal();
        if (!program.empty() && fs::exists(file, error)) return file.string();
    }
    return name;
}

}  // namespace neumann
