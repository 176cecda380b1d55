// The state that AttributeBegin and AttributeEnd save and restore.
#pragma once

#include "core/reader/formats/pbrt/pbrt_scene.h"

#include <map>
#include <memory>

namespace neumann::reader::pbrt {

struct GraphicsState {
    Mat4 to_world{1.0};           // the current transformation matrix
    bool moves_end_only = false;  // after ActiveTransform EndTime: transforms only change the end of a motion
    bool reversed = false;
    MaterialUse material = {};
    std::optional<std::size_t> light = {};
    // The parameters that directives Attribute give to all shapes, lights and so on that follow; shared until they change.
    std::map<std::string, std::shared_ptr<const std::vector<Parameter>>> defaults = {};
};

}  // namespace neumann::reader::pbrt
