// `neumann merge A B C -o DIR`: renders of one scene by different seeds, or parts of one, become one.
#pragma once

#include "apps/output/files/chosen_files.h"

#include <string>
#include <vector>

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

// Returns the exit code, 0. Throws InputError and RunError.
int merge_command(const MergeRequest& request);

}  // namespace neumann
