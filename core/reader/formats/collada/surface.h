// What a material is made of: the elements of a Mitsuba file that say the same.
#pragma once

#include "core/reader/formats/collada/import.h"

#include <optional>
#include <set>
#include <string>

namespace neumann::reader::collada {

struct Surface {
    std::optional<Element> bsdf;             // without it, nothing is reflected
    std::optional<Element> emitter;          // <emitter type="area">
    std::set<std::string> coordinates = {};  // that its textures ask for, by the names in <texture texcoord>
};

// By <profile_COMMON>. `name` of the material, for warnings.
Surface read_common_effect(const Element& effect, const std::string& name, const Import& import);
// By a course's technique (course_technique()). Throws InputError.
Surface read_course_effect(const Element& technique, const std::string& name, const Import& import);

// A bsdf that reflects on both sides.
Element two_sided(Element bsdf);
// The diffuse one of a surface without material.
Element default_bsdf(const Location& place);

}  // namespace neumann::reader::collada
