#include "tests/fuzz/fuzz_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return neumann::fuzz::try_mesh(data, size, [](const std::string& path) { return neumann::read_ply(path); });
}
