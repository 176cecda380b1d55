#include "core/reader/file_kinds.h"

#include "core/base/error.h"
#include "core/base/input_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

struct Kind {
    std::string_view ending, beginning;  // `beginning`: bytes that no other kind begins with, or empty
    std::string_view what;               // such as "a Blender file"
    std::string_view remedy;
};

constexpr std::string_view
    in_a_scene = "name it in a scene file: <shape type=\"{0}\"><string name=\"filename\" value=\"{1}\"/></shape>",
    in_tungsten = "name it in a scene of Tungsten: {{\"type\": \"mesh\", \"file\": \"{1}\"}}",
    as_gltf = "export the scene as glTF 2.0 (.glb) from the program that made it",
    as_picture = "a scene file names it as a texture, <texture type=\"bitmap\">, or as light from afar, <emitter type=\"envmap\">",
    unpacked = "unpack it first";

constexpr std::array other_kinds = {
    Kind{".blend", "BLENDER", "a Blender file", as_gltf},
    Kind{".obj", "", "a mesh", in_a_scene},
    Kind{".ply", "ply\n", "a mesh", in_a_scene},
    Kind{".serialized", "", "a mesh", in_a_scene},
    Kind{".wo3", "", "a mesh", in_tungsten},
    Kind{".stl", "solid ", "a mesh", as_gltf},
    Kind{".fbx", "Kaydara FBX", "an FBX file", as_gltf},
    Kind{".3ds", "", "a 3ds file", as_gltf},
    Kind{".usd", "PXR-USDC", "a USD file", as_gltf},
    Kind{".usda", "#usda", "a USD file", as_gltf},
    Kind{".usdc", "", "a USD file", as_gltf},
    Kind{".usdz", "", "a USD file", as_gltf},
    Kind{".abc", "", "an Alembic file", as_gltf},
    Kind{".c4d", "", "a Cinema 4D file", as_gltf},
    Kind{".ma", "//Maya", "a Maya file", as_gltf},
    Kind{".mb", "", "a Maya file", as_gltf},
    Kind{".max", "", "a 3ds Max file", as_gltf},
    Kind{".skp", "", "a SketchUp file", as_gltf},
    Kind{".x3d", "", "an X3D file", as_gltf},
    Kind{".mtl", "", "a file of materials of a mesh", as_gltf},
    Kind{".exr", "\x76\x2f\x31\x01", "a picture", as_picture},
    Kind{".png", "\x89PNG", "a picture", as_picture},
    Kind{".jpg", "\xff\xd8\xff", "a picture", as_picture},
    Kind{".jpeg", "", "a picture", as_picture},
    Kind{".hdr", "#?RADIANCE", "a picture", as_picture},
    Kind{".pfm", "", "a picture", as_picture},
    Kind{".tif", "", "a picture", as_picture},
    Kind{".tiff", "", "a picture", as_picture},
    Kind{".bmp", "", "a picture", as_picture},
    Kind{".tga", "", "a picture", as_picture},
    Kind{".zip", "PK\x03\x04", "an archive", unpacked},
    Kind{".gz", "\x1f\x8b", "a compressed file", unpacked},
    Kind{".7z", "7z\xbc\xaf", "an archive", unpacked},
    Kind{".rar", "Rar!", "an archive", unpacked},
    Kind{".tar", "", "an archive", unpacked},
    Kind{".xz", "\xfd\x37zXZ", "a compressed file", unpacked},
};

std::string beginning_of(const std::string& path) {
    std::array<char, 512> bytes{};
    std::ifstream file(path, std::ios::binary);
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return {bytes.data(), static_cast<std::size_t>(file.gcount())};
}

[[noreturn]] void refuse(const std::string& path, const Kind& kind) {
    const std::string type = std::string(kind.ending.substr(1)), name = std::filesystem::path(path).filename().string();
    throw InputError(
        fmt::format("{}: this is {}, not a scene; {}", path, kind.what, fmt::format(fmt::runtime(kind.remedy), type, name)));
}

}  // namespace

SceneFormat scene_format(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (path.ends_with(".pbrt.gz")) return SceneFormat::pbrt;
    std::error_code error;
    const bool is_there = !why_not_input(path);
    if (std::filesystem::is_regular_file(path, error))
        for (const Kind& kind : other_kinds)
            if (ending == kind.ending) refuse(path, kind);
    const std::string beginning = is_there ? beginning_of(path) : "";
    for (const Kind& kind : other_kinds)
        if (!kind.beginning.empty() && beginning.starts_with(kind.beginning)) refuse(path, kind);
    if (ending == ".dae") return SceneFormat::collada;
    if (ending == ".gltf" || ending == ".glb") return SceneFormat::gltf;
    if (ending == ".pbrt") return SceneFormat::pbrt;
    if (ending == ".json") return SceneFormat::tungsten;
    // The first bytes tell more than .xml or any other ending.
    if (beginning.starts_with("glTF")) return SceneFormat::gltf;
    if (beginning.find("<COLLADA") != std::string::npos) return SceneFormat::collada;
    const std::size_t first = beginning.find_first_not_of("\xEF\xBB\xBF \t\r\n");
    if (is_there && ending != ".xml" && (first == std::string::npos || beginning[first] != '<') &&
        !beginning.starts_with("\xFF\xFE") && !beginning.starts_with("\xFE\xFF"))
        throw InputError(
            path +
            ": this is no scene that is known by its ending or its beginning, expected XML of Mitsuba 3 (.xml), glTF 2.0 "
            "(.glb, .gltf), pbrt-v4 (.pbrt), COLLADA (.dae) or Tungsten (.json)");
    return SceneFormat::mitsuba;
}

}  // namespace neumann::reader
