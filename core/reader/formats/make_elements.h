// Makes the elements of a scene, for importers. Each has the place in the importer's own file from which it comes, so
// that problems are reported there. Texts are taken literally: a $ in them is no parameter.
#pragma once

#include "core/base/vec.h"
#include "core/reader/xml/element.h"

#include <cstdint>
#include <string>

namespace neumann::reader {

// The element <scene version="3.0.0">.
Element make_scene_element(const Location& place);
// An object such as <bsdf type="diffuse" id="wall">; without an id if that is empty.
Element make_object(const std::string& tag, const std::string& type, const Location& place, const std::string& id = "");
// Adds a child and returns it; the reference is valid until the next child is added.
Element& add(Element& parent, Element child);
// Adds a reference to the object with this id, as a parameter of this name unless the name is empty.
void add_reference(Element& parent, const std::string& id, const Location& place, const std::string& name = "");

// These add parameters. Numbers are written so that the same numbers are read back.
void add_float(Element& parent, const std::string& name, double value, const Location& place);
void add_integer(Element& parent, const std::string& name, std::int64_t value, const Location& place);
void add_boolean(Element& parent, const std::string& name, bool value, const Location& place);
void add_string(Element& parent, const std::string& name, const std::string& value, const Location& place);
void add_rgb(Element& parent, const std::string& name, const Rgb& value, const Location& place);
void add_point(Element& parent, const std::string& name, const Vec3& value, const Location& place);
void add_vector(Element& parent, const std::string& name, const Vec3& value, const Location& place);
void add_matrix(Element& parent, const std::string& name, const Mat4& value, const Location& place);

// Adds a parameter that -D can set, with its value otherwise: <integer name="width" value="$width"/> and, in the scene,
// <default name="width" value="768"/>. `tag` is "integer" or the like.
void add_defined(Element& scene, Element& parent, const std::string& tag, const std::string& name, const std::string& definition,
                 const std::string& value, const Location& place);
// Adds the type of an object, which -D can set.
void add_defined_type(Element& scene, Element& object, const std::string& definition, const std::string& type);
// Adds a transform; -D can set the 16 numbers of its matrix, row by row.
void add_defined_matrix(Element& scene, Element& parent, const std::string& name, const std::string& definition, const Mat4& value,
                        const Location& place);
// The 16 numbers of the matrix, row by row, separated by blanks.
std::string matrix_text(const Mat4& m);

}  // namespace neumann::reader
