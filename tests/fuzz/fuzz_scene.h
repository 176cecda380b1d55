// A scene file of a fuzzer, read up to the search structures. An InputError is what the readers are for; anything else ends the
// process.
#pragma once

#include "core/base/error.h"
#include "core/reader/read_scene.h"

#include <cstdlib>
#include <string>

namespace neumann::fuzz {

// What a scene promises: a material and a light, or none, for each shape.
inline int try_scene(const std::string& path) {
    try {
        const SceneParts parts = read_scene_parts(path, {}, true);
        if (parts.shapes.size() != parts.sides_of_shape.size() || parts.shapes.size() != parts.lights.of_shape.size()) std::abort();
    } catch (const InputError&) {
    }
    return 0;
}

}  // namespace neumann::fuzz
