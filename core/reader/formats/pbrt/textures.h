// The textures of a pbrt file, by name, and parameters that may be textures.
#pragma once

#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/formats/pbrt/texture_values.h"

#include <map>
#include <optional>
#include <set>
#include <string>

namespace neumann::reader::pbrt {

class Textures {
public:
    Textures(PbrtScene& scene, Importer& importer);

    // Reads a reflectance, transmittance or the like, from 0 to 1: an rgb, a spectrum or a texture. Nothing if it is not given.
    std::optional<TextureValue> find_reflectance(Parameters& p, const std::string& name);
    // Reads a number: a float or a texture.
    std::optional<TextureValue> find_number(Parameters& p, const std::string& name);
    // Reads a texture that is given by its name.
    std::optional<TextureValue> find_texture(Parameters& p, const std::string& name, bool is_float);

private:
    TextureValue make(TextureEntity& e);
    TextureValue make_picture(TextureEntity& e);
    TextureValue make_checks(TextureEntity& e);
    TextureValue operand(TextureEntity& e, const std::string& name, double missing);
    UvMapping read_mapping(Parameters& p);

    Importer& importer_;
    // Textures of colours, and of numbers. One that could not be made is in both, as a neutral grey.
    std::map<std::string, TextureValue> textures_[2];
};

}  // namespace neumann::reader::pbrt
