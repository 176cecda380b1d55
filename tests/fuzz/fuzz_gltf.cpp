// A glTF file, read up to the search structures. The first byte says whether the rest is a .gltf, or the JSON and the binary chunk
// of a .glb that begin well. Beside it is a picture.
#include "tests/fuzz/fuzz_mesh.h"
#include "tests/fuzz/fuzz_scene.h"

#include <fstream>

namespace {

std::string word(std::size_t value) {
    const auto v = static_cast<std::uint32_t>(value);
    return {reinterpret_cast<const char*>(&v), sizeof v};
}

const std::filesystem::path& folder() {
    static const std::filesystem::path result = [] {
        const std::filesystem::path made = neumann::fuzz::path() + ".folder";
        std::filesystem::create_directories(made);
        std::ofstream(made / "a.bin") << std::string(256, '\1');
        return made;
    }();
    return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const std::string rest(data + 1, data + size), path = (folder() / "scene.gltf").string();
    const std::size_t end = std::min(rest.find('\0'), rest.size());
    const std::string json = rest.substr(0, end), binary = rest.substr(end);
    const std::string glb = "glTF" + word(2) + word(28 + rest.size()) + word(json.size()) + "JSON" + json + word(binary.size()) +
                            std::string("BIN\0", 4) + binary;
    std::ofstream(path, std::ios::binary) << (data[0] & 1 ? glb : rest);
    return neumann::fuzz::try_scene(path);
}
