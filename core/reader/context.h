// What the readers of the single plugins share.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/document.h"
#include "core/reader/objects.h"

namespace neumann::reader {

struct Context {
    const Document& document;
    const Objects& objects;
    Warnings& warnings;
    std::vector<std::string>& mesh_files;  // that were read, in their order
};

}  // namespace neumann::reader
