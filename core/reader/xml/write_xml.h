// Elements as the text of an XML file.
#pragma once

#include "core/reader/xml/element.h"

namespace neumann::reader {

// Of a document, whose parameters are put in: a $ is written as \$, which is read as itself.
std::string write_xml(const Element& root);

}  // namespace neumann::reader
