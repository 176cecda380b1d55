// A scene file, read up to the search structures. Beside it are a mesh, a picture and a spectrum, and it may include itself.
#include "tests/fuzz/fuzz_mesh.h"
#include "tests/fuzz/fuzz_scene.h"

#include <fstream>

namespace {

std::string write_neighbours() {
    const std::filesystem::path folder = neumann::fuzz::path() + ".folder";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "a.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
    std::ofstream(folder / "a.pgm") << "P2 2 3 255\n1 2 3 4 5 255\n";
    std::ofstream(folder / "a.spd") << "400 1\n500 2\n700 1\n";
    std::ofstream(folder / "part.xml") << "<scene version='3.0.0'><bsdf type='diffuse' id='of part'/></scene>";
    std::filesystem::create_symlink(neumann::fuzz::path(), folder / "scene.xml");
    return folder / "scene.xml";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    neumann::fuzz::write_input(data, size);
    static const std::string scene = write_neighbours();
    return neumann::fuzz::try_scene(scene);
}
