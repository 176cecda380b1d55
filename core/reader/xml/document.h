// A scene file and all that it includes, as one tree without <include>, <default> and <path>, and with spectra as lists.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/xml/objects.h"

#include <map>

namespace neumann::reader {

struct Document {
    Element root;                      // <scene>
    std::vector<std::string> files;    // the XML files and spectra that were read, in their order
    std::vector<std::string> folders;  // where files are looked for: those of <path>, the last first, and the main scene's
    bool lost_folder = false;          // there are others, which are not known
    LostIds lost;

    // The file that an attribute names: in the folders, or beside the file that the attribute stands in. Throws InputError if there
    // is none.
    std::string find_file(const Attribute& name) const;
};

// What was upgraded in files of older versions is noted in `warnings`. Definitions that nothing uses are a problem, unless they are
// `optional`. What is wrong is added to `problems`, and marked as broken in the document; throws InputError where the main file
// cannot be read as a scene at all.
Document read_document(const std::string& path, const std::map<std::string, std::string>& definitions, Warnings& warnings,
                       Problems& problems, bool optional = false);

}  // namespace neumann::reader
