// What `neumann convert` is asked for.
#pragma once

#include "apps/requests/option.h"
#include "apps/requests/scene_file.h"

namespace neumann {

struct ConvertRequest {
    SceneFile scene;
    std::string output;
    bool quiet = false;
};

const Options<ConvertRequest>& convert_options();

}  // namespace neumann
