// A scene file, read up to the search structures. It may name other files only where there are none.
#include "core/reader/read_scene.h"
#include "tests/fuzz/fuzz_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    neumann::fuzz::write_input(data, size);
    try {
        const neumann::SceneParts parts = neumann::read_scene_parts(neumann::fuzz::path());
        if (parts.shapes.size() != parts.sides_of_shape.size() || parts.shapes.size() != parts.lights.of_shape.size()) std::abort();
    } catch (const neumann::InputError&) {
    }
    return 0;
}
