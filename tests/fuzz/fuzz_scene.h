// A scene file of a fuzzer, read up to the search structures. An InputError is what the readers are for; anything else ends the
// process.
#pragma once

#include "core/base/error.h"
#include "core/reader/read_scene.h"

#include <cstdlib>
#include <string>

namespace neumann::fuzz {

// What a scene promises: a material and a light, or none, for each shape.
inline void check(const SceneParts& parts) {
    if (parts.shapes.size() != parts.sides_of_shape.size() || parts.shapes.size() != parts.lights.of_shape.size()) std::abort();
}

// A lenient reader replaces something exactly where the strict one has errors.
inline int try_scene(const std::string& path) {
    bool is_right = false;
    try {
        check(read_scene_parts(path, {}, {.optional_definitions = true}));
        is_right = true;
    } catch (const InputError&) {
    }
    try {
        const SceneParts parts = read_scene_parts(path, {}, {.optional_definitions = true, .lenient = true});
        check(parts);
        if (is_right != parts.replaced.empty()) std::abort();
    } catch (const InputError&) {
        if (is_right) std::abort();
    }
    return 0;
}

}  // namespace neumann::fuzz
