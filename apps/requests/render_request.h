// The request of `neumann render`.
#pragma once

#include "apps/requests/chosen_files.h"
#include "apps/requests/option.h"
#include "apps/requests/scene_file.h"
#include "operators/render/methods/goal.h"
#include "operators/render/methods/method_options.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct RenderRequest {
    SceneFile scene;
    std::string output;  // a folder; empty: out/NAME
    MethodText method;
    Goal goal;
    std::optional<double> memory;                    // GiB
    std::vector<std::string> files = file_groups();  // the groups that are written beside run.json
    std::vector<std::string> paths;                  // "X,Y", and "named": whose paths the page shows
    std::string theme = "dark";                      // or "white": the background of sheets and strips
    std::string reference;                           // a folder of an earlier render, or empty
    std::optional<double> checkpoint;                // seconds between two states on disk
    std::string resume;  // the folder of a render that this one continues; other options are as in that render
    int threads = 0;     // 0: all
    bool quiet = false, json = false;
    bool touch = false;                 // adds "touch" to `files`
    std::optional<std::uint16_t> live;  // the port of a page that shows the render meanwhile; 0: any free port
    std::string tev;                    // HOST:PORT of a tev that shows the pictures meanwhile, or empty
    std::string command_line;           // as typed, for run.json
};

const Options<RenderRequest>& render_options();

}  // namespace neumann
