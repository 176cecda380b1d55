// Pictures that shine: an environment's, and the `bitmap` textures that a light throws.
#pragma once

#include "core/emitter/slide.h"
#include "core/reader/context.h"
#include "core/reader/properties.h"

#include <optional>

namespace neumann::reader {

// The file becomes part of the scene's hash. Throws InputError where a pixel is negative or not finite.
Image read_light_image(const Attribute& filename, bool raw, const Context& context);

Slide read_bitmap(const Element& e, const Context& context);
// The <texture> of this name inside an emitter, if there is one.
std::optional<Slide> read_slide(Properties& p, const std::string& name, const Context& context);

}  // namespace neumann::reader
