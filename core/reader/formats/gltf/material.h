// A material of a glTF file, before it becomes a <bsdf>.
#pragma once

#include "core/reader/formats/gltf/textures.h"

#include <optional>
#include <string>

namespace neumann::reader::gltf {

// A number, and a texture of which one channel is multiplied by it.
struct Amount {
    double factor = 0.0;
    std::optional<Texture> texture = {};
    int channel = 0;

    bool is_zero() const { return factor == 0.0; }
};

struct Material {
    std::string name = "default";
    Location place = {};

    Rgb base{1.0};
    double alpha = 1.0;
    std::optional<Texture> base_texture = {};  // with alpha
    Amount metallic = {1.0, {}, 2}, roughness = {1.0, {}, 1};
    std::optional<Texture> normals = {};

    Rgb emission{0.0};  // radiance
    std::optional<Texture> emission_texture = {};

    enum class Alpha { opaque, cut_out, blended } alpha_mode = Alpha::opaque;
    double cutoff = 0.5;
    bool is_double_sided = false;

    double eta = 1.5;
    double specular = 1.0;  // factor of the dielectric's reflectance
    Amount transmission = {};
    bool is_solid = false;  // light passes the boundary of a body, not a thin sheet
    double clearcoat = 0.0, clearcoat_gloss = 1.0;
    double sheen = 0.0;

    bool emits() const { return max_component(emission) > 0.0; }
    // The textures that have an effect.
    std::vector<const Texture*> textures() const;
};

// Reports what is wrong with the material, and reads on without it. Warns of what has an effect and is approximated or left out.
Material read_material(JsonObject object, const Textures& textures);

}  // namespace neumann::reader::gltf
