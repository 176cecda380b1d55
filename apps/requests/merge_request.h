// What `neumann merge` is asked for.
#pragma once

#include "apps/requests/chosen_files.h"
#include "apps/requests/option.h"

namespace neumann {

struct MergeRequest {
    std::vector<std::string> folders;
    std::string output;
    std::string scene;  // where it is now; empty: where it was
    std::vector<std::string> files = file_groups();
    std::string theme = "dark";
    int threads = 0;  // 0: all
    bool quiet = false;
    std::string command_line;  // as typed, for run.json
};

const Options<MergeRequest>& merge_options();

}  // namespace neumann
