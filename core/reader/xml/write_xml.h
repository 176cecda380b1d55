// Writes elements as the text of an XML file.
#pragma once

#include "core/reader/xml/element.h"

namespace neumann::reader {

// Writes a document in which parameters are substituted: a $ is written as \$, which is read back as $.
std::string write_xml(const Element& root);

}  // namespace neumann::reader
