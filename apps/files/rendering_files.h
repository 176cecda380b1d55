// A finished render, and all that `neumann render` leaves of it in its folder.
#pragma once

#include "apps/files/output_folder.h"
#include "operators/methods/bounce_series.h"

#include <nlohmann/json.hpp>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace neumann {

struct Rendering {
    std::string scene_file, command_line;
    std::map<std::string, std::string> definitions;
    std::shared_ptr<const Scene> scene;
    BounceSeries series;
    double seconds = 0.0;  // that it took, before anything is written

    // Of the scene and of the render.
    Warnings warnings() const;
    // What is sick, a line each; `folder`: for how to replay it.
    std::vector<std::string> complaints(const std::string& folder) const;
};

struct WrittenRendering {
    Warnings warnings;  // those of the files too
    nlohmann::ordered_json run;
};

// Writes and commits it. Throws RunError where not all of it reaches the disk.
WrittenRendering write_rendering(const Rendering& rendering, OutputFolder& folder);

// Then, so that nothing that was sampled is lost: all of it in a new folder where temporary files go, if there is room, and
// otherwise as many pictures of bounces as fit into a new folder beside `output`. Returns what was done, a line for the user.
std::string keep_elsewhere(const Rendering& rendering, const std::string& output);

}  // namespace neumann
