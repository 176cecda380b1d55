// Light for a scene whose file has none.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/xml/element.h"

namespace neumann::reader {

// Adds <emitter type="constant"> of radiance 1, which -D surroundings overrides, and warns of it.
void add_surroundings(Element& scene, Warnings& warnings);

// Whether there is an <emitter>, in a shape or without one.
bool has_emitters(const Element& scene);

}  // namespace neumann::reader
