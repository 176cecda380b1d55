// `neumann render --resume DIR`: the options of the render that began there, and those that may change.
#pragma once

#include <nlohmann/json.hpp>

namespace CLI {
class App;
}

namespace neumann {

struct RenderRequest;

// The options as they were typed: {"SCENE": ["room.xml"], "--spp": ["64"], "-D": ["a=1", "b=2"]}.
nlohmann::ordered_json given_options(const CLI::App& command);

// Those that a resumed render begins with: without where it is written, how it is shown and on how many threads it runs.
nlohmann::ordered_json lasting(nlohmann::ordered_json options);

// The request with which the render in request.resume began, with the limits, the files and the threads that are given now. Throws
// InputError if there is no such render, and if another option is given that it did not have ("--resume: --seed is 2, and it was
// 1").
RenderRequest resumed(const RenderRequest& request);

}  // namespace neumann
