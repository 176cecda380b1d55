// A scene as its file has it: the elements of a Mitsuba file for the same scene, before includes and parameters are
// resolved, and the files that these elements name and that are not on disk. An importer of another format makes one of
// these; the rest of the reader does not know of formats.
#pragma once

#include "core/image/texels.h"
#include "core/reader/meshes/mesh_file.h"
#include "core/reader/xml/element.h"

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace neumann::reader {

// The -D of the command line: the values of parameters by their names.
using NamedValues = std::map<std::string, std::string>;

// Files by the name that a parameter `filename` gives.
struct FilesInMemory {
    std::map<std::string, std::shared_ptr<const MeshFile>> meshes;  // for shapes 'ply'
    std::map<std::string, std::shared_ptr<const Texels>> pictures;
};

struct RawScene {
    Element root;                         // <scene>
    std::vector<std::string> files = {};  // files that were read for it, the main one first; for the scene's hash
    FilesInMemory in_memory = {};
    // This text is hashed in place of the main file, if there is none and the first of `files` is just a name.
    std::string text = {};
    std::set<std::string> used = {};  // names of the -D that the importer itself has looked at
};

}  // namespace neumann::reader
