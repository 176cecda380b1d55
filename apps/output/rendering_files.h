// A finished render, and the files that `neumann render` writes for it.
#pragma once

#include "apps/output/files/output_folder.h"
#include "apps/requests/chosen_files.h"
#include "apps/requests/chosen_pixels.h"
#include "apps/requests/render_request.h"
#include "core/base/processes/processes.h"
#include "operators/fields/matrix/separated_scene.h"
#include "operators/render/methods/bounce_series.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <vector>

namespace neumann {

struct Rendering {
    RenderRequest request;
    std::shared_ptr<const Scene> scene;
    BounceSeries series;
    double seconds = 0.0;  // total time before writing
    ChosenFiles files = {};
    ChosenPixels paths = {};                                    // the paths that the page shows
    std::shared_ptr<const SeparatedScene> separated = nullptr;  // for touch.html; made when it is written if it is not there
    // The number of processes that rendered it together, and the traffic of the first one.
    int processes = 1;
    Processes::Traffic traffic = {};

    Warnings warnings() const;
    // Messages about problems, one line each; `folder`: named in the command that replays them.
    std::vector<std::string> complaints(const std::string& folder) const;
};

struct WrittenRendering {
    Warnings warnings;  // including those about the files
    nlohmann::ordered_json run;
    std::string page_data;     // the data that index.html shows; empty if it was not chosen
    std::string why_no_paths;  // the reason why a page that should have paths has none; empty otherwise
};

// Writes the chosen files and commits them. Throws RunError if not everything can be written, and for touch.html as separate()
// does.
WrittenRendering write_rendering(const Rendering& rendering, OutputFolder& folder);

// The data that a page shows of a render whose files are not written.
std::string page_data(const Rendering& rendering, bool is_under_way);

// For use after such an error, so that the samples are not lost: writes everything into a new temporary folder if there
// is room, and otherwise as many pictures of bounces as fit into a new folder beside `output`. Returns a line that
// reports the result to the user.
std::string keep_elsewhere(const Rendering& rendering, const std::string& output);

}  // namespace neumann
