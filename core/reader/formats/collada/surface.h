// The parts of a material, as elements of a Mitsuba file.
#pragma once

#include "core/reader/formats/collada/import.h"

#include <optional>
#include <set>
#include <string>

namespace neumann::reader::collada {

struct Surface {
    std::optional<Element> bsdf;             // nothing is reflected if missing
    std::optional<Element> emitter;          // <emitter type="area">
    std::set<std::string> coordinates = {};  // the names in <texture texcoord> that its textures use
};

// Reads <profile_COMMON>. `name` is that of the material, for warnings.
Surface read_common_effect(const Element& effect, const std::string& name, const Import& import);
// Reads a course's technique (course_technique()). Throws InputError.
Surface read_course_effect(const Element& technique, const std::string& name, const Import& import);

// Makes a bsdf reflect on both sides.
Element two_sided(Element bsdf);
// The diffuse bsdf of a surface without material.
Element default_bsdf(const Location& place);

}  // namespace neumann::reader::collada
