// A scene as its file has it: the elements of a Mitsuba file that says so, before includes and parameters are resolved, and the
// files that these elements name and that are not on the disk. An importer of another format makes one of these; the rest of the
// reader does not know of formats.
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

// The -D of the command line: a parameter's name and its value.
using NamedValues = std::map<std::string, std::string>;

// By the name that a parameter `filename` gives.
struct FilesInMemory {
    std::map<std::string, std::shared_ptr<const MeshFile>> meshes;  // of shapes 'ply'
    std::map<std::string, std::shared_ptr<const Texels>> pictures;
};

struct RawScene {
    Element root;                         // <scene>
    std::vector<std::string> files = {};  // that were read for it, the main one first; for the scene's hash
    FilesInMemory in_memory = {};
    // What is hashed in place of the main file, where that is none and the first of `files` is just its name.
    std::string text = {};
    std::set<std::string> used = {};  // names of the command line's -D that the importer itself has looked at
};

}  // namespace neumann::reader
