// What the commands are asked that read the folders of renders.
#pragma once

#include "apps/requests/chosen_files.h"
#include "apps/requests/option.h"

namespace neumann {

// `neumann compare`
struct CompareRequest {
    std::string a, b;               // two pictures or two folders; b is the reference
    std::string output;             // the folder of a page of all folders, or empty
    std::vector<std::string> more;  // folders that the page has besides
    bool flip = false, json = false;
};

const Options<CompareRequest>& compare_options();

// `neumann merge`
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

// `neumann page`
struct PageRequest {
    std::string folder;
    std::vector<std::string> files = page_file_groups();
    std::string theme;               // empty: that of the render
    std::vector<std::string> paths;  // "X,Y", and "named"
    int threads = 0;                 // 0: all
    bool quiet = false;
};

const Options<PageRequest>& page_options();

// `neumann replay`
struct ReplayRequest {
    std::string folder;
    std::optional<std::uint64_t> number;      // number of a sample in the health report
    std::optional<std::array<int, 2>> pixel;  // or the sample's pixel x, y
    std::optional<std::uint64_t> sample;      // and its number in the pixel
    bool json = false;
};

const Options<ReplayRequest>& replay_options();

}  // namespace neumann
