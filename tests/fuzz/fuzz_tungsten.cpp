// A scene of Tungsten, read up to the search structures. What follows the first zero is the mesh beside it, a.wo3; there are a
// picture and a .obj, too.
#include "tests/fuzz/fuzz_mesh.h"
#include "tests/fuzz/fuzz_scene.h"

#include <fstream>

namespace {

const std::filesystem::path& folder() {
    static const std::filesystem::path result = [] {
        const std::filesystem::path made = neumann::fuzz::path() + ".folder";
        std::filesystem::create_directories(made);
        std::ofstream(made / "a.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        std::ofstream(made / "a.pfm", std::ios::binary) << "PF\n2 3\n-1.0\n" << std::string(72, '\0');
        return made;
    }();
    return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string input(data, data + size), path = (folder() / "scene.json").string();
    const std::size_t end = std::min(input.find('\0'), input.size());
    std::ofstream(path, std::ios::binary) << input.substr(0, end);
    std::ofstream(folder() / "a.wo3", std::ios::binary) << input.substr(std::min(end + 1, input.size()));
    return neumann::fuzz::try_scene(path);
}
