// A scene file and all that it includes, as one tree without <include>, <default> and <path>, and with spectra as lists.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/xml/objects.h"
#include "core/reader/xml/raw_scene.h"

#include <map>

namespace neumann::reader {

struct Document {
    Element root;                      // <scene>
    std::vector<std::string> files;    // the scene files and spectra that were read, in their order
    std::vector<std::string> folders;  // search path for files: folders of <path>, the last first, and the main scene's folder
    bool lost_folder = false;          // a <path> could not be read, so the search path is incomplete
    LostIds lost;
    FilesInMemory in_memory;

    // The file that an attribute names, searched in the folders and next to the file that contains the attribute. Throws InputError
    // if there is none.
    std::string find_file(const Attribute& name) const;
};

// `scene` is as it was read from the first of its files. Upgrades of files of older versions are noted in `warnings`.
// Unused definitions are a problem, unless they are `optional`. Errors are added to `problems`, and the elements are
// marked as broken in the document. Throws InputError if the main file cannot be read as a scene at all.
Document read_document(RawScene scene, const std::map<std::string, std::string>& definitions, Warnings& warnings,
                       Problems& problems, bool optional = false);

}  // namespace neumann::reader
