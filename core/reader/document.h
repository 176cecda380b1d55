// A scene file and all that it includes, as one tree without <include>, <default> and <path>.
#pragma once

#include "core/reader/element.h"

#include <map>

namespace neumann::reader {

struct Document {
    Element root;                      // <scene>
    std::vector<std::string> files;    // the XML files that were read, in their order
    std::vector<std::string> folders;  // where files are looked for: the main scene's folder, and those of <path>

    // The file that an attribute names: in the folders, or beside the file that the attribute stands in. Throws InputError if there
    // is none.
    std::string find_file(const Attribute& name) const;
};

// Definitions that nothing uses are an error, unless they are `optional`.
Document read_document(const std::string& path, const std::map<std::string, std::string>& definitions, bool optional = false);

}  // namespace neumann::reader
