// Reads an XML file as a tree of elements, unchanged.
#pragma once

#include "core/reader/xml/element.h"

namespace neumann::reader {

// Elements nested deeper than this are left out; the caller must refuse them.
constexpr int max_element_depth = 100;

// Throws InputError if the file cannot be read, is not XML, or has several outermost elements.
Element parse_xml(const std::string& path);

}  // namespace neumann::reader
