// Adds the camera of a glTF file as a <sensor>.
#pragma once

#include "core/geometry/bounds.h"
#include "core/reader/formats/gltf/nodes.h"
#include "core/reader/xml/raw_scene.h"

namespace neumann::reader::gltf {

// Adds the sensor to the scene, with a film whose size -D width and -D height set. -D camera chooses among several cameras by name,
// or by number among those of the scene; without it the first is used, with a warning. Throws InputError.
void add_camera(Element& scene, const std::vector<Placed>& placed, const JsonList& cameras, const NamedValues& definitions,
                Notes& notes);

// Adds a three-quarter view of everything.
void add_default_camera(Element& scene, const Bounds& bounds, const NamedValues& definitions);

}  // namespace neumann::reader::gltf
