// Parameters that may vary over a surface: a colour or a number, or a <texture> in its place: `bitmap`, `checkerboard`,
// `mesh_attribute` or `rawconstant`.
#pragma once

#include "core/material/surface_function.h"
#include "core/reader/plugins/color.h"
#include "core/reader/plugins/context.h"
#include "core/reader/xml/properties.h"

namespace neumann::reader {

struct Texture {
    SurfaceFunction value;
    Rgb smallest{0.0};
    // (∂/∂u, ∂/∂v) of the luminance; empty where there is none.
    std::function<Vec2(const ShadingPoint&)> slope = {};
    // Of a picture, or enough to see what there is.
    int width = 64, height = 64;
};

// `illuminant`: what its colours are seen under; none where a number is asked for.
Texture read_texture(const Element& e, std::optional<Illuminant> illuminant, const Context& context);
// The same for what cannot be negative, called `name`.
Texture read_not_negative(const Element& e, const std::string& name, std::optional<Illuminant> illuminant, const Context& context);

// A colour; `missing` in all channels where it is not given.
SurfaceFunction read_color_texture(Properties& p, const std::string& name, double missing, Illuminant illuminant,
                                   const Context& context);
// A colour, if a <texture> says it.
std::optional<SurfaceFunction> find_color_texture(Properties& p, const std::string& name, Illuminant illuminant,
                                                  const Context& context);
// A picture's texels, read only once for all textures; the file becomes part of the scene's hash.
std::shared_ptr<const Texels> read_texels(const Attribute& filename, const Context& context);

// A number, in all channels; of a picture its luminance, and of any other colour, as in Mitsuba, the mean of its channels.
SurfaceFunction read_number_texture(Properties& p, const std::string& name, double missing, const Context& context);

// The attributes that the textures on a shape ask its mesh for, and the elements that name them.
std::map<std::string, const Element*> mesh_attributes_of(const Element& shape, const Objects& objects);

}  // namespace neumann::reader
