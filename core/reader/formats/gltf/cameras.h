// The camera of a glTF file as a <sensor>.
#pragma once

#include "core/geometry/bounds.h"
#include "core/reader/formats/gltf/nodes.h"
#include "core/reader/xml/raw_scene.h"

namespace neumann::reader::gltf {

// Adds the sensor to the scene, with a film that -D width and -D height choose. Of several cameras the one whose name, or number
// among those of the scene, -D camera gives; the first without it, with a warning. Throws InputError.
void add_camera(Element& scene, const std::vector<Placed>& placed, const JsonList& cameras, const NamedValues& definitions,
                Notes& notes);

// A three-quarter view of everything.
void add_default_camera(Element& scene, const Bounds& bounds, const NamedValues& definitions);

}  // namespace neumann::reader::gltf
