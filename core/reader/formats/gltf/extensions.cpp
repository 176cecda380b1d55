#include "core/reader/formats/gltf/extensions.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

namespace neumann::reader::gltf {

namespace {

constexpr std::array<std::string_view, 14> known = {
    "EXT_mesh_gpu_instancing",  "KHR_lights_punctual",    "KHR_materials_anisotropy",        "KHR_materials_clearcoat",
    "KHR_materials_dispersion", "KHR_materials_ior",      "KHR_materials_emissive_strength", "KHR_materials_iridescence",
    "KHR_materials_sheen",      "KHR_materials_specular", "KHR_materials_transmission",      "KHR_materials_unlit",
    "KHR_materials_volume",     "KHR_texture_transform"};

// Accessors read quantized meshes without an extension. Textures in other formats have a PNG or a JPEG beside them, or
// else lack their source, which is reported.
constexpr std::array<std::string_view, 9> without_effect = {
    "KHR_animation_pointer", "KHR_materials_variants", "KHR_mesh_quantization", "KHR_texture_basisu", "KHR_xmp",
    "KHR_xmp_json_ld",       "EXT_texture_webp",       "EXT_texture_avif",      "MSFT_texture_dds"};

struct Refused {
    std::string_view name, remedy = "", instead = "left out";
};
constexpr std::string_view uncompressed = "; export the scene without the compression of meshes",
                           as_png = "; export the pictures as PNG or JPEG", no_mesh = "what it compresses is left out",
                           no_picture = "its pictures are not read";
constexpr std::array refused = {Refused{"KHR_draco_mesh_compression", uncompressed, no_mesh},
                                Refused{"EXT_meshopt_compression", uncompressed, no_mesh},
                                Refused{"KHR_meshopt_compression", uncompressed, no_mesh},
                                Refused{"KHR_texture_basisu", as_png, no_picture},
                                Refused{"EXT_texture_webp", as_png, no_picture},
                                Refused{"EXT_texture_avif", as_png, no_picture},
                                Refused{"MSFT_texture_dds", as_png, no_picture}};

bool is_known(const std::string& extension) { return std::find(known.begin(), known.end(), extension) != known.end(); }

}  // namespace

bool has_no_effect(const std::string& extension) {
    return std::find(without_effect.begin(), without_effect.end(), extension) != without_effect.end();
}

void check_extensions(JsonObject& root) {
    Notes& notes = root.notes();
    const auto names = [&](const char* list_name, const auto& check) {
        const JsonList list = root.list(list_name);
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (list[i].is_string())
                check(list[i].template get<std::string>(), list.place_of(i));
            else
                notes.problems.add(InputError(list.place_of(i), "not a text, expected the name of an extension"), list.place_of(i));
        }
    };
    std::set<std::string> required;
    names("extensionsRequired", [&](const std::string& name, const Location& place) {
        required.insert(name);
        const auto found = std::find_if(refused.begin(), refused.end(), [&](const Refused& r) { return r.name == name; });
        if (found == refused.end() && (is_known(name) || has_no_effect(name))) return;
        notes.extensions.insert(name);
        notes.refused.insert(name);
        const Refused how = found == refused.end() ? Refused{name} : *found;
        notes.problems.add(Unknown(place, fmt::format("the file requires the extension {}, which is not supported", name),
                                   std::string(how.remedy), std::string(how.instead)),
                           place);
    });
    names("extensionsUsed", [&](const std::string& name, const Location&) {
        if (!required.count(name) && !is_known(name) && !has_no_effect(name)) notes.left_out(name);
    });
}

void fail_compressed(const std::string& extension, const Location& place, const Notes& notes) {
    if (notes.refused.contains(extension) && !notes.problems.lenient()) throw AlreadyReported();
    throw Unknown(place, fmt::format("compressed by {}, which is not supported", extension), std::string(uncompressed), "left out");
}

}  // namespace neumann::reader::gltf
