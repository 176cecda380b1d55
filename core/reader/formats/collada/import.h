// The state that the parts of the importer share.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/formats/collada/file.h"
#include "core/reader/xml/raw_scene.h"

namespace neumann::reader::collada {

struct Import {
    const File& file;
    RawScene& scene;  // the scene that is made
    const NamedValues& definitions;
    Warnings& warnings;
    Problems& problems;
};

}  // namespace neumann::reader::collada
