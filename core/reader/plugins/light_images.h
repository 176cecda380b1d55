// Reads pictures of lights: environment maps, and textures that a light projects.
#pragma once

#include "core/emitter/slide.h"
#include "core/image/image.h"
#include "core/reader/plugins/context.h"
#include "core/reader/xml/properties.h"

#include <optional>

namespace neumann::reader {

// Returns linear values. Throws InputError if a pixel is negative.
Image read_light_image(const Attribute& filename, const Context& context);

// The <texture> of this name inside an emitter, if there is one without errors.
std::optional<Slide> read_slide(Properties& p, const std::string& name, const Context& context);

}  // namespace neumann::reader
