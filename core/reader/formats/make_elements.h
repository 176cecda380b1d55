// Makes the elements of a scene, for importers. Each has the place in the importer's own file from which it comes, so that what is
// wrong with it is told there. Texts are taken as they are: a $ in them is no parameter.
#pragma once

#include "core/base/vec.h"
#include "core/reader/xml/element.h"

#include <cstdint>
#include <string>

namespace neumann::reader {

// <scene version="3.0.0">.
Element make_scene_element(const Location& place);
// An object such as <bsdf type="diffuse" id="wall">; without an id where that is empty.
Element make_object(const std::string& tag, const std::string& type, const Location& place, const std::string& id = "");
// Adds a child, and returns it until the next is added.
Element& add(Element& parent, Element child);
// The object with this id, as a parameter of this name unless that is empty.
void add_reference(Element& parent, const std::string& id, const Location& place, const std::string& name = "");

// Parameters. Numbers are written so that they are read as the same.
void add_float(Element& parent, const std::string& name, double value, const Location& place);
void add_integer(Element& parent, const std::string& name, std::int64_t value, const Location& place);
void add_boolean(Element& parent, const std::string& name, bool value, const Location& place);
void add_string(Element& parent, const std::string& name, const std::string& value, const Location& place);
void add_rgb(Element& parent, const std::string& name, const Rgb& value, const Location& place);
void add_point(Element& parent, const std::string& name, const Vec3& value, const Location& place);
void add_vector(Element& parent, const std::string& name, const Vec3& value, const Location& place);
void add_matrix(Element& parent, const std::string& name, const Mat4& value, const Location& place);

// A parameter that -D sets, with the value that it has without: <integer name="width" value="$width"/> and, in the scene,
// <default name="width" value="768"/>. `tag`: "integer" or the like.
void add_defined(Element& scene, Element& parent, const std::string& tag, const std::string& name, const std::string& definition,
                 const std::string& value, const Location& place);
// The same for the type of an object.
void add_defined_type(Element& scene, Element& object, const std::string& definition, const std::string& type);
// The same for a transform: -D sets the 16 numbers of its matrix, row by row.
void add_defined_matrix(Element& scene, Element& parent, const std::string& name, const std::string& definition, const Mat4& value,
                        const Location& place);
// These 16 numbers, separated by blanks.
std::string matrix_text(const Mat4& m);

}  // namespace neumann::reader
