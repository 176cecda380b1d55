#include "core/reader/formats/gltf/uri.h"

#include "core/reader/formats/json_file.h"
#include "core/reader/formats/percent_encoding.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>

#include <fmt/format.h>

namespace neumann::reader::gltf {

namespace {

namespace fs = std::filesystem;

// Decodes base64, RFC 4648. Padding may be missing.
std::string decode_base64(std::string_view text, const Location& place) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    constexpr std::uint8_t none = 64;
    static const std::array<std::uint8_t, 256> value_of = [&] {
        std::array<std::uint8_t, 256> table;
        table.fill(none);
        for (std::size_t i = 0; i < digits.size(); ++i) table[static_cast<unsigned char>(digits[i])] = static_cast<std::uint8_t>(i);
        return table;
    }();
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t buffer = 0;
    int bits = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::uint8_t value = value_of[static_cast<unsigned char>(text[i])];
        if (value == none) throw InputError(place, fmt::format("character {} of the data is no base64", i + 1));
        buffer = buffer << 6 | value;
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes += static_cast<char>(buffer >> bits & 0xff);
    }
    return bytes;
}

std::string shortened(const std::string& uri) {
    constexpr std::size_t longest = 60;
    return uri.size() <= longest ? uri : uri.substr(0, longest) + "…";
}

}  // namespace

std::string read_uri(const std::string& uri, const std::string& gltf_path, const Location& place, std::vector<std::string>& files) {
    if (uri.starts_with("data:")) {
        const std::size_t comma = uri.find(',');
        if (comma == std::string::npos || !uri.substr(0, comma).ends_with(";base64"))
            throw InputError(place, fmt::format("'{}' is no data in base64, expected 'data:…;base64,…'", shortened(uri)));
        return decode_base64(std::string_view(uri).substr(comma + 1), place);
    }
    if (uri.find("://") != std::string::npos)
        throw InputError(place, fmt::format("'{}' is not a file of this machine, expected a path", shortened(uri)));
    const fs::path folder = fs::path(gltf_path).parent_path();
    std::string decoded = percent_decoded(uri), with_slashes = decoded;
    std::replace(with_slashes.begin(), with_slashes.end(), '\\', '/');
    std::error_code error;
    std::string path = (folder / decoded).string();
    for (const std::string& other : {uri, with_slashes})
        if (!fs::exists(path, error) && fs::exists(folder / other, error)) path = (folder / other).string();
    std::string bytes = read_bytes(path, place);
    files.push_back(path);
    return bytes;
}

}  // namespace neumann::reader::gltf
