// Scene files of Mitsuba 0.4 to 0.6, which name things otherwise, as Mitsuba 3 upgrades them. What Mitsuba 3 leaves as it is, is
// refused by name where it is read.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/element.h"

namespace neumann::reader {

// To be called before an element's place is checked, and when all in it is read. A note in `warnings` says what was upgraded.
void upgrade_tag(Element& e, Warnings& warnings);
void upgrade_parameters(Element& e, Warnings& warnings);

}  // namespace neumann::reader
