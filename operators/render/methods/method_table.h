// All methods, and what their options exclude.
#pragma once

#include "operators/render/methods/method.h"

#include <vector>

namespace neumann {

// With their defaults, in the order of the help.
const std::vector<Method>& all_methods();
// Throws InputError if options exclude each other. `lights`: --lights was given.
void expect_sense(const Method& method, bool lights);

}  // namespace neumann
