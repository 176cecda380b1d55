// Reads the textures of a material: which picture, at which texture coordinates.
#pragma once

#include "core/reader/formats/gltf/pictures.h"
#include "core/reader/formats/json_object.h"
#include "core/reader/xml/element.h"

#include <string>

namespace neumann::reader::gltf {

struct Texture {
    Location place = {};
    std::size_t image = 0;
    int coordinates = 0;  // the set TEXCOORD_n
    Mat4 to_uv{1.0};
    std::string wrap = "repeat";
    bool is_nearest = false;
    double amount = 1.0;  // `scale` of a normal texture
};

class Textures {
public:
    Textures(JsonObject& root, const Pictures& pictures)
        : textures_(root.list("textures")), samplers_(root.list("samplers")), images_(pictures.list()) {}

    // The texture of a property, or nothing if it is missing, or (with a report) wrong.
    std::optional<Texture> read(JsonObject& parent, const std::string& name) const;

private:
    std::optional<Texture> read(JsonObject info) const;
    void read_sampler(JsonObject sampler, Texture& texture) const;

    JsonList textures_, samplers_, images_;
};

// A <texture type="bitmap"> of a picture in memory; `raw`: its values are numbers, not colours.
Element make_bitmap(const Texture& texture, const std::string& name, const std::string& filename, bool raw);

}  // namespace neumann::reader::gltf
