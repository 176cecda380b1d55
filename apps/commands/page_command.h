// `neumann page DIR`: page, slides, strips and tables anew from the files of a render.
#pragma once

#include <string>
#include <vector>

namespace neumann {

struct PageRequest {
    std::string folder;
    std::vector<std::string> files;  // of page_file_groups()
    std::string theme;               // empty: that of the render
    std::vector<std::string> paths;  // "X,Y", and "named"
    int threads = 0;                 // 0: all
    bool quiet = false;
};

// "tables", "sheets", "strips", "page".
const std::vector<std::string>& page_file_groups();

// Returns the exit code, 0. Throws InputError and RunError.
int page_command(const PageRequest& request);

}  // namespace neumann
