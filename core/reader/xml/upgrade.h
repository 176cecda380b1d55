// Upgrades scene files of Mitsuba 0.4 to 0.6 to the names of Mitsuba 3, as Mitsuba 3 does. It also upgrades some features that
// Mitsuba 3 refuses although their meaning is clear: `ldrfilm`, removed samplers and texture filters, `strictNormals`, `extEta`,
// `gamma`. Everything else is left unchanged, and refused by name where it is read.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/xml/element.h"

namespace neumann::reader {

// Call upgrade_tag() before an element's place is checked, and upgrade_parameters() when all of its contents are read. `warnings`
// say what was upgraded. Throws InputError for features that no longer have a meaning.
void upgrade_tag(Element& e, Warnings& warnings);
void upgrade_parameters(Element& e, Warnings& warnings);
// Upgrades the names of Mitsuba 2; call it after upgrade_parameters() in files of all older versions.
void upgrade_from_2(Element& e);

}  // namespace neumann::reader
