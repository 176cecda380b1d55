// The requests of commands that read the folders of renders.
#pragma once

#include "apps/requests/chosen_files.h"
#include "apps/requests/option.h"

namespace neumann {

struct CompareRequest {
    std::string a, b;                    // two pictures or two folders; b is the reference
    std::string output = {};             // the folder for a page of all folders, or empty
    std::vector<std::string> more = {};  // further folders on the page
    bool flip = false, json = false;
};

const Options<CompareRequest>& compare_options();

struct MergeRequest {
    std::vector<std::string> folders;
    std::string output;
    std::string scene;  // its present path; empty: the path in the renders
    std::vector<std::string> files = file_groups();
    std::string theme = "dark";
    int threads = 0;  // 0: all
    bool quiet = false;
    std::string command_line;  // as typed, for run.json
};

const Options<MergeRequest>& merge_options();

struct PageRequest {
    std::string folder;
    std::vector<std::string> files = page_file_groups();
    std::string theme;               // empty: that of the render
    std::vector<std::string> paths;  // "X,Y", and "named"
    int threads = 0;                 // 0: all
    bool quiet = false;
};

const Options<PageRequest>& page_options();

struct ReplayRequest {
    std::string folder;
    std::optional<std::uint64_t> number;      // number of a sample in the health report
    std::optional<std::array<int, 2>> pixel;  // or the sample's pixel x, y
    std::optional<std::uint64_t> sample;      // and its number in the pixel
    bool json = false;
};

const Options<ReplayRequest>& replay_options();

}  // namespace neumann
