// glTF files made in the test, and what the reader makes of them.
#pragma once

#include "tests/reader/xml_scene_files.h"

#include <cstdint>
#include <vector>

#include <zlib.h>
#include <nlohmann/json.hpp>

namespace neumann {

using Json = nlohmann::json;

inline std::string base64(const std::string& bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = three << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[three >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// 8 bits a channel, of which there are 1 to 4, row by row.
inline std::string encode_png_of(int width, int channels, const std::vector<std::uint8_t>& texels) {
    const auto big_endian = [](std::size_t v) {
        return std::string{static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8), static_cast<char>(v)};
    };
    const auto chunk = [&](const std::string& name, const std::string& data) {
        const std::string body = name + data;
        const auto sum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
        return big_endian(data.size()) + body + big_endian(sum);
    };
    const std::size_t row = static_cast<std::size_t>(width * channels), height = texels.size() / row;
    std::string raw;
    for (std::size_t y = 0; y < height; ++y)
        raw += '\0' + std::string(texels.begin() + static_cast<std::ptrdiff_t>(y * row),
                                  texels.begin() + static_cast<std::ptrdiff_t>((y + 1) * row));
    uLongf length = compressBound(raw.size());
    std::string packed(length, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &length, reinterpret_cast<const Bytef*>(raw.data()), raw.size());
    packed.resize(length);
    const char colour_type[] = {0, 0, 4, 2, 6};
    const std::string header =
        big_endian(static_cast<std::size_t>(width)) + big_endian(height) + std::string{8, colour_type[channels], 0, 0, 0};
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", packed) + chunk("IEND", "");
}

class GltfTest : public XmlTest {
protected:
    // Adds numbers to the file's only buffer; returns the accessor that reads them.
    template <class T>
    std::size_t add_accessor(const std::string& type, const std::vector<T>& values, bool normalized = false) {
        const int component = std::is_same_v<T, float>           ? 5126
                              : std::is_same_v<T, std::uint32_t> ? 5125
                              : std::is_same_v<T, std::uint16_t> ? 5123
                              : std::is_same_v<T, std::int16_t>  ? 5122
                              : std::is_same_v<T, std::uint8_t>  ? 5121
                                                                 : 5120;
        const std::size_t width = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<std::size_t>(type[3] - '0');
        Json accessor = {{"bufferView", add_view(bytes_of(values))},
                         {"componentType", component},
                         {"count", values.size() / width},
                         {"type", type}};
        if (normalized) accessor["normalized"] = true;
        file["accessors"].push_back(accessor);
        return file["accessors"].size() - 1;
    }
    std::size_t add_view(const std::string& bytes) {
        while (buffer.size() % 4 != 0) buffer += '\0';
        file["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
        buffer += bytes;
        return file["bufferViews"].size() - 1;
    }
    // A picture as a texture; returns its index.
    std::size_t add_texture(const std::string& png) {
        file["images"].push_back({{"bufferView", add_view(png)}, {"mimeType", "image/png"}});
        file["textures"].push_back({{"source", file["images"].size() - 1}});
        return file["textures"].size() - 1;
    }
    // The unit square in z = 0, seen from +z, whose texture coordinates begin at the upper left; as mesh 0 in node 0.
    void add_square() {
        const std::size_t positions = add_accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
        const std::size_t coordinates = add_accessor<float>("VEC2", {0, 1, 1, 1, 1, 0, 0, 0});
        const std::size_t indices = add_accessor<std::uint16_t>("SCALAR", {0, 1, 2, 0, 2, 3});
        primitive() = {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", coordinates}}}, {"indices", indices}};
        file["nodes"][0]["mesh"] = 0;
    }
    Json& primitive() { return file["meshes"][0]["primitives"][0]; }
    Json& material() {
        primitive()["material"] = 0;
        return file["materials"][0];
    }
    Json& basis() { return material()["pbrMetallicRoughness"]; }
    Json& extension(const std::string& name) { return material()["extensions"][name]; }

    std::string text() const {
        Json whole = file;
        if (!buffer.empty()) whole["buffers"] = {{{"byteLength", buffer.size()}, {"uri", "data:;base64," + base64(buffer)}}};
        return whole.dump();
    }
    SceneParts read_gltf(const Definitions& definitions = {}) const {
        write("scene.gltf", text());
        return read_scene_parts(path("scene.gltf"), definitions);
    }
    std::string gltf_error(const Definitions& definitions = {}) const {
        write("scene.gltf", text());
        return error_of(path("scene.gltf"), definitions);
    }
    // The error after a part of the file, by its pointer, has been set to something else.
    std::string error_with(const std::string& pointer, const Json& value) const {
        GltfTest* const self = const_cast<GltfTest*>(this);
        const Json before = file;
        self->file[Json::json_pointer(pointer)] = value;
        const std::string error = gltf_error();
        self->file = before;
        return error;
    }
    // All warnings but those of missing cameras and lights, a line each.
    static std::string warnings(const SceneParts& parts) {
        std::string all;
        for (const auto& [text, count] : parts.warnings.counts())
            if (!text.starts_with("the file has no ")) all += text + "\n";
        return all;
    }
    static const TriangleMesh& mesh(const SceneParts& parts, std::size_t i = 0) {
        return std::get<TriangleMesh>(parts.shapes.at(i));
    }

    Json file = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}, {"nodes", {Json::object()}}};
    std::string buffer;
};

}  // namespace neumann
