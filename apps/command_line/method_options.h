// How a series is rendered: --method, and the options that belong to methods.
#pragma once

#include "apps/commands/render.h"

#include <string>

namespace CLI {
class App;
}

namespace neumann {

void add_method_options(CLI::App& command, RenderRequest& request);

// The same in one word: "walk:direct=bsdf:lights=power" for --method walk --direct bsdf --lights power. Throws InputError.
RenderRequest parse_method(const std::string& text);

}  // namespace neumann
