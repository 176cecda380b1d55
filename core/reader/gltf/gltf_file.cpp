#include "core/reader/gltf/gltf_file.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

namespace neumann::reader::gltf {

namespace {

static_assert(std::endian::native == std::endian::little);

std::uint32_t word(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

Location place_in(const std::string& path, std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const std::size_t line_start = before.rfind('\n') + 1;  // 0 where there is none
    return {path, static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
            static_cast<int>(before.size() - line_start) + 1};
}

// What the library says beside its own name and the place.
std::string reason(const std::exception& e) {
    const std::string_view what = e.what(), mark = ": ";
    const std::size_t at = what.find(mark);
    return std::string(at == std::string_view::npos ? what : what.substr(at + mark.size()));
}

nlohmann::json parse_json(const std::string& path, std::string_view text) {
    try {
        return nlohmann::json::parse(text.begin(), text.end());
    } catch (const nlohmann::json::parse_error& e) {
        throw InputError(place_in(path, text, e.byte > 0 ? e.byte - 1 : 0), "broken JSON: " + reason(e));
    } catch (const nlohmann::json::exception& e) {
        throw InputError(Location{path}, fmt::format("broken JSON: {}", e.what()));
    }
}

}  // namespace

GltfFile::GltfFile(const std::string& path) : bytes_(read_bytes(path, {path})) {
    std::string_view text = bytes_;
    if (text.starts_with("glTF")) text = open_glb(path);
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
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

std::string read_bytes(const std::string& path, const Location& place) {
    namespace fs = std::filesystem;
    // The scene file itself needs no name beside its place.
    const std::string name = place.pointer.empty() ? "" : fmt::format("'{}' ", path);
    std::error_code error;
    if (!fs::exists(path, error))
        throw InputError(place, name.empty() ? "there is no such file" : fmt::format("there is no file '{}'", path));
    if (!fs::is_regular_file(path, error))
        throw InputError(place, fmt::format("{}is a {}, expected a {}file", name,
                                            fs::is_directory(path, error) ? "folder" : "device", name.empty() ? "scene " : ""));
    std::ifstream stream(path, std::ios::binary);
    std::string bytes(fs::file_size(path, error), '\0');
    if (error || !stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
        throw InputError(place, name + "cannot be read");
    return bytes;
}

}  // namespace neumann::reader::gltf
