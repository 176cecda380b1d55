// The request of `neumann strip`.
#pragma once

#include "apps/requests/render_request.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct StripRequest {
    RenderRequest render;  // what the renders of all tiles share; its output is the folder of the strip, empty: out/NAME-WHAT
    std::string vary;      // one of varied_things()
    std::vector<std::string> values;         // empty: those of the lectures
    std::optional<std::array<int, 2>> mark;  // the pixel x, y that all tiles show
};

// "samples", "shadow-rays", …
const std::vector<std::string>& varied_things();

const Options<StripRequest>& strip_options();

}  // namespace neumann
