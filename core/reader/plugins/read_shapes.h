// All shapes of a scene: their files are read side by side, and groups are put where their instances are.
//
// An instance is expanded into shapes of its own. Patches, area sampling and the choice of lights then see it as any other surface,
// and a hit names it by its shape alone; the price is memory for every copy, which is checked before it is taken.
#pragma once

#include "core/reader/plugins/shapes.h"

#include <functional>

namespace neumann::reader {

// Calls `take` for one shape after the other, in the order of the file. What is wrong is left out.
void read_shapes(const Element& root, const Context& context, const std::function<void(ReadShape)>& take);

}  // namespace neumann::reader
