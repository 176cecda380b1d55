// A render from a scene in memory to pictures in memory, and these as a folder of files.
#pragma once

#include "apps/files/output_folder.h"
#include "apps/rendering/render_method.h"

#include <functional>
#include <memory>

namespace neumann {

// What was asked for, what of the scene it was rendered with, and what came out. It stays where it is: parts refer to each other.
struct Rendering {
    RenderRequest request;
    Scene scene;  // without what the plan leaves out
    Pilot pilot;
    Plan plan;
    RenderResult result;
    double seconds = 0.0;  // that it took, before anything is written

    RenderJob job() const { return {request, scene, pilot, plan}; }
    // Of the scene and of the render.
    Warnings warnings() const;
    // What is sick, a line each; `folder`: for how to replay it.
    std::vector<std::string> complaints(const std::string& folder) const;
};

// Throws InputError and RunError. `progress` and `chosen` as in RenderJob.
std::unique_ptr<Rendering> render(
    const RenderRequest& request, Scene scene,
    const std::function<void(int, const RenderProgress&)>& progress = [](int, const RenderProgress&) {},
    const std::function<void(int)>& chosen = [](int) {});

struct WrittenRendering {
    Warnings warnings;  // those of the files too
    nlohmann::ordered_json run;
};

// Writes and commits all that `neumann render` leaves in its folder. Throws RunError where not all of it reaches the disk.
WrittenRendering write_rendering(const Rendering& rendering, OutputFolder& folder);

// Then, so that nothing that was sampled is lost: all of it in a new folder where temporary files go, if there is room, and
// otherwise as many pictures of bounces as fit into a new folder beside `output`. Returns what was done, a line for the user.
std::string keep_elsewhere(const Rendering& rendering, const std::string& output);

}  // namespace neumann
