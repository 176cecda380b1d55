#include "core/reader/formats/gltf/gltf_file.h"

#include "core/reader/formats/json_file.h"

#include <bit>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

namespace neumann::reader::gltf {

namespace {

static_assert(std::endian::native == std::endian::little);

std::uint32_t word(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

}  // namespace

GltfFile::GltfFile(const std::string& path) : bytes_(read_bytes(path, {path})) {
    std::string_view text = bytes_;
    if (text.starts_with("glTF")) text = open_glb(path);
    root_ = parse_json(path, text);
}

std::string_view GltfFile::open_glb(const std::string& path) {
    const Location file{path};
    constexpr std::size_t header = 12, chunk_header = 8;
    constexpr std::uint32_t json = 0x4E4F534A, binary = 0x004E4942;
    const std::string_view all = bytes_;
    if (all.size() < header + chunk_header)
        throw InputError(file, fmt::format("the file has {} bytes, expected at least the {} of the headers of a .glb", all.size(),
                                           header + chunk_header));
    if (const std::uint32_t version = word(all, 4); version != 2)
        throw InputError(file, fmt::format("a .glb of version {}, expected 2", version));
    if (const std::uint32_t length = word(all, 8); length > all.size())
        throw InputError(file, fmt::format("the file ends after {} bytes, but its header says that it has {}", all.size(), length));
    std::string_view text;
    std::size_t at = header;
    for (int i = 0; at + chunk_header <= all.size(); ++i) {
        const std::size_t size = word(all, at);
        const std::uint32_t type = word(all, at + 4);
        at += chunk_header;
        if (size > all.size() - at)
            throw InputError(file, fmt::format("chunk {} of the .glb ends {} bytes beyond the file", i, size - (all.size() - at)));
        if (i == 0 && type != json) throw InputError(file, "the first chunk of the .glb is not JSON");
        if (i == 0) text = all.substr(at, size);
        if (i == 1 && type == binary) {
            has_binary_ = true;
            binary_at_ = at;
            binary_size_ = size;
        }
        at += size;
    }
    return text;
}

}  // namespace neumann::reader::gltf
