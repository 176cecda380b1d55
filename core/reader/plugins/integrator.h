// Reads <integrator>: `path` and its like, `direct`, and `aov` and `moment` around one of them.
#pragma once

#include "core/reader/plugins/context.h"

#include <optional>

namespace neumann::reader {

struct Integrator {
    std::optional<int> bounces;  // the last bounce, if the file limits them
    bool hide_emitters = false;
};

Integrator read_integrator(const Element& e, const Context& context);

}  // namespace neumann::reader
