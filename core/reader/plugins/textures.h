// Reads parameters that may vary over a surface: a colour or a number, or a <texture> in its place (`bitmap`,
// `checkerboard`, `mesh_attribute`, `rawconstant`, or `scale` around one of them).
#pragma once

#include "core/material/surface_function.h"
#include "core/reader/plugins/color.h"
#include "core/reader/plugins/context.h"
#include "core/reader/xml/properties.h"

namespace neumann::reader {

struct Texture {
    SurfaceFunction value;
    Rgb smallest{0.0};
    // (∂/∂u, ∂/∂v) of the luminance; empty if not available.
    std::function<Vec2(const ShadingPoint&)> slope = {};
    // Size of the picture; for other textures, a resolution that shows their details.
    int width = 64, height = 64;
};

// `illuminant` is for converting spectra to colours; none if a number is wanted.
Texture read_texture(const Element& e, std::optional<Illuminant> illuminant, const Context& context);
// The same for a parameter `name` that must not be negative.
Texture read_not_negative(const Element& e, const std::string& name, std::optional<Illuminant> illuminant, const Context& context);

// Reads a colour; `missing` in all channels if it is not given.
SurfaceFunction read_color_texture(Properties& p, const std::string& name, double missing, Illuminant illuminant,
                                   const Context& context);
// Reads a colour, if it is given by a <texture>.
std::optional<SurfaceFunction> find_color_texture(Properties& p, const std::string& name, Illuminant illuminant,
                                                  const Context& context);
// A picture's texels, read once for all textures; the file becomes part of the scene's hash.
std::shared_ptr<const Texels> read_texels(const Attribute& filename, const Context& context);

// Reads a number into all channels: the luminance of a picture or, as in Mitsuba, the mean of the channels of any other colour.
SurfaceFunction read_number_texture(Properties& p, const std::string& name, double missing, const Context& context);

// The mesh attributes that the textures on a shape need, and the elements that name them.
std::map<std::string, const Element*> mesh_attributes_of(const Element& shape, const Objects& objects);

}  // namespace neumann::reader
