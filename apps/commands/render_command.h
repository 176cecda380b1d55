// `neumann render`: a scene in, its bounce pictures out.
#pragma once

#include "apps/live/viewer.h"
#include "apps/output/rendering_files.h"
#include "operators/render/methods/goal.h"
#include "operators/render/methods/method_options.h"
#include "operators/render/methods/saving.h"

#include <limits>

namespace neumann {

struct RenderRequest {
    std::string scene;
    std::vector<std::string> definition_texts;       // -D name=value, as typed
    std::map<std::string, std::string> definitions;  // the same, parsed
    bool lenient = false;
    std::string output;  // a folder; empty: out/NAME
    MethodText method;
    Goal goal;
    std::optional<double> memory;                    // GiB
    std::vector<std::string> files = file_groups();  // those that are written beside run.json
    std::vector<std::string> paths;                  // "X,Y", and "named": whose paths the page shows
    std::string theme = "dark";                      // or "white": the background of sheets and strips
    std::string reference;                           // a folder of an earlier render, or empty
    int threads = 0;                                 // 0: all
    bool quiet = false;
    bool json = false;
    std::optional<std::uint16_t> live;  // the port of a page that fills meanwhile, 0: any that is free
    std::string tev;                    // HOST:PORT of a tev that shows the pictures meanwhile, or empty
    std::string resume;                 // the folder of a render that this one goes on with; the request is as that one began
    std::string scene_hash;             // of that one
    std::optional<double> checkpoint;   // seconds between two states on disk
    nlohmann::ordered_json options;     // as typed, by name, for a resumed render
    std::string command_line;           // as typed, for run.json
};

// Returns the exit code, 0 also if Ctrl-C ended it early. Throws InputError and RunError.
int render_command(const RenderRequest& request);

// Those who see what there is so far, the part of the time that it takes to show it to all of them, and after how many seconds
// there should be something new.
struct Viewers {
    std::vector<Viewer*> all;
    SmallShare share;
    double longest_unseen = std::numeric_limits<double>::infinity();
};
// Viewers that somebody asked for.
Viewers asked_for(std::vector<Viewer*> all);

// The same for a scene in memory, with the pictures kept in memory. `watch` must not have a judge. Throws InputError and RunError.
std::shared_ptr<Rendering> render(const RenderRequest& request, std::shared_ptr<const Scene> scene, const Watch& watch,
                                  Saving saving = {}, Viewers* viewers = nullptr);

}  // namespace neumann
