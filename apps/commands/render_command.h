// `neumann render`: renders the bounce pictures of a scene.
#pragma once

#include "apps/live/viewer.h"
#include "apps/output/rendering_files.h"
#include "apps/requests/render_request.h"
#include "operators/render/methods/saving.h"

#include <limits>

namespace neumann {

// Returns the exit code, 0 also if Ctrl-C ended it early. Throws InputError and RunError.
int render_command(const RenderRequest& request);

// The viewers of a render that is under way, the part of the time that showing it to all of them may take, and the
// seconds after which there should be something new.
struct Viewers {
    std::vector<Viewer*> all;
    SmallShare share;
    double longest_unseen = std::numeric_limits<double>::infinity();
};
Viewers chosen_viewers(std::vector<Viewer*> all);

// Renders a scene in memory, and into memory. `watch` must not have a judge. Throws InputError and RunError.
std::shared_ptr<Rendering> render(const RenderRequest& request, std::shared_ptr<const Scene> scene, const Watch& watch,
                                  Saving saving = {}, Viewers* viewers = nullptr);

}  // namespace neumann
