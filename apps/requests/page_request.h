// What `neumann page` is asked for.
#pragma once

#include "apps/requests/chosen_files.h"
#include "apps/requests/option.h"

namespace neumann {

struct PageRequest {
    std::string folder;
    std::vector<std::string> files = page_file_groups();
    std::string theme;               // empty: that of the render
    std::vector<std::string> paths;  // "X,Y", and "named"
    int threads = 0;                 // 0: all
    bool quiet = false;
};

const Options<PageRequest>& page_options();

}  // namespace neumann
