// The bytes after the first are the file, and the first is the index of the mesh. Mutations of compressed data are seldom
// compressed data, so half of the inputs hold a mesh as it is before compression.
#include "tests/fuzz/fuzz_mesh.h"

#include <vector>

#include <zlib.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const std::uint64_t index = data[0] >> 1 & 3;
    std::vector<std::uint8_t> file(data + 1, data + size);
    if (data[0] & 1) {
        uLongf length = compressBound(size - 1);
        file.assign(4 + length, 0);
        file[0] = 0x1c;
        file[1] = 0x04;
        file[2] = data[0] & 8 ? 3 : 4;
        if (compress(file.data() + 4, &length, data + 1, size - 1) != Z_OK) std::abort();
        file.resize(4 + length);
    }
    return neumann::fuzz::try_mesh(file.data(), file.size(),
                                   [&](const std::string& path) { return neumann::read_serialized(path, index); });
}
