// Pictures that shine: an environment's, and the textures that a light throws.
#pragma once

#include "core/emitter/slide.h"
#include "core/image/image.h"
#include "core/reader/plugins/context.h"
#include "core/reader/xml/properties.h"

#include <optional>

namespace neumann::reader {

// Linear. Throws InputError where a pixel is negative.
Image read_light_image(const Attribute& filename, const Context& context);

// The <texture> of this name inside an emitter, if there is one that is right.
std::optional<Slide> read_slide(Properties& p, const std::string& name, const Context& context);

}  // namespace neumann::reader
