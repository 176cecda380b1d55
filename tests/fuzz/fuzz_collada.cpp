// COLLADA files.
#include "tests/fuzz/fuzz_mesh.h"
#include "tests/fuzz/fuzz_scene.h"

namespace {

// The reader knows the format by the name.
const std::string& scene_file() {
    static const std::string link = [] {
        const std::filesystem::path path = neumann::fuzz::path() + ".dae";
        std::error_code error;
        std::filesystem::remove(path, error);
        std::filesystem::create_symlink(neumann::fuzz::path(), path);
        return path.string();
    }();
    return link;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    neumann::fuzz::write_input(data, size);
    return neumann::fuzz::try_scene(scene_file());
}
