// Reads all shapes of a scene: files are read in parallel, and groups are expanded at their instances. The shapes inside a `merge`,
// which Mitsuba makes one mesh of where it can, are read as if they stood in its place.
//
// An instance becomes shapes of its own. Patches, area sampling and the choice of lights then treat it like any other surface, and
// a hit identifies it by its shape alone; the price is memory for every copy, which is checked before it is allocated.
#pragma once

#include "core/reader/plugins/shape_plugins.h"

#include <functional>

namespace neumann::reader {

// Calls `take` for one shape after the other, in the order of the file. Shapes with errors are left out.
void read_shapes(const Element& root, const Context& context, const std::function<void(ReadShape)>& take);

}  // namespace neumann::reader
