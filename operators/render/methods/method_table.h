// All methods, and the check of options that exclude each other.
#pragma once

#include "operators/render/methods/method.h"

#include <vector>

namespace neumann {

// All methods with their default options, in the order of the help.
const std::vector<Method>& all_methods();
// Throws InputError if options exclude each other. `lights`: --lights was given.
void expect_sense(const Method& method, bool lights);

}  // namespace neumann
