// COLLADA files.
#include "core/reader/read_scene.h"
#include "tests/fuzz/fuzz_mesh.h"

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
    try {
        const neumann::SceneParts parts = neumann::read_scene_parts(scene_file());
        if (parts.shapes.size() != parts.sides_of_shape.size() || parts.shapes.size() != parts.lights.of_shape.size()) std::abort();
    } catch (const neumann::InputError&) {
    }
    return 0;
}
