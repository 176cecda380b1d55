// Makes lights that are no surfaces, as <emitter> elements.
#pragma once

#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/xml/element.h"

#include <vector>

namespace neumann::reader::pbrt {

std::vector<Element> make_lights(PbrtScene& scene, Importer& importer);

}  // namespace neumann::reader::pbrt
