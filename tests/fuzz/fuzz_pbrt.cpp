// A pbrt file, read up to the search structures. Beside it are a mesh, a picture and a spectrum, and it may include itself.
#include "tests/fuzz/fuzz_mesh.h"
#include "tests/fuzz/fuzz_scene.h"

#include <fstream>

namespace {

std::string write_neighbours() {
    const std::filesystem::path folder = neumann::fuzz::path() + ".folder";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "a.ply")
        << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    std::ofstream(folder / "a.pgm") << "P2 2 2 255\n1 2 3 255\n";
    std::ofstream(folder / "a.spd") << "400 1\n500 2\n700 1\n";
    std::ofstream(folder / "part.pbrt") << "Material \"diffuse\"\n";
    std::filesystem::create_symlink(neumann::fuzz::path(), folder / "scene.pbrt");
    return folder / "scene.pbrt";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    neumann::fuzz::write_input(data, size);
    static const std::string scene = write_neighbours();
    return neumann::fuzz::try_scene(scene);
}
