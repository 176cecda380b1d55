// Scene files of Mitsuba 0.4 to 0.6, which name things otherwise, as Mitsuba 3 upgrades them; and what Mitsuba 3 refuses although
// there is no doubt of what it asks for: `ldrfilm`, samplers and texture filters that are gone, `strictNormals`, `extEta`, `gamma`.
// The rest is left as it is, and refused by name where it is read.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/xml/element.h"

namespace neumann::reader {

// To be called before an element's place is checked, and when all in it is read. Notes in `warnings` say what was upgraded. Throws
// InputError for what has no meaning today.
void upgrade_tag(Element& e, Warnings& warnings);
void upgrade_parameters(Element& e, Warnings& warnings);

}  // namespace neumann::reader
