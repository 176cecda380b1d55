// --method and the options that belong to methods, as operators/render/methods describes them.
#pragma once

#include "operators/render/methods/method_options.h"

namespace CLI {
class App;
}

namespace neumann {

void add_method_options(CLI::App& command, MethodText& method);

}  // namespace neumann
