// Code shared by the commands that treat a scene as matrices: options, and construction of space, table, R and channels.
#pragma once

#include "apps/requests/patch_request.h"
#include "core/base/limits.h"
#include "core/base/processes/processes.h"
#include "core/base/warnings.h"
#include "operators/fields/matrix/traced_system.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

// The scene of a command, read and traced. During its lifetime it limits the number of threads.
class PatchScene {
public:
    // Throws InputError that names the scene and what is wrong, and Stopped at Ctrl-C.
    explicit PatchScene(const PatchOptions& options);
    // For several processes together, which all must call it; `petsc`: SLEPc's options.
    PatchScene(const PatchOptions& options, Processes& processes, const std::string& petsc);
    // Uses a scene that was read before.
    PatchScene(const PatchOptions& options, std::shared_ptr<const Scene> scene);

    const Scene& scene() const { return *scene_; }
    const MatrixSystem& system() const { return *system_; }
    // The system; only if it belongs to one process alone.
    const TracedSystem& traced() const { return dynamic_cast<const TracedSystem&>(*system_); }

    // "", or "r", "g", "b", as in names of files.
    const char* channel_letter(int c) const;

    std::vector<std::string> warnings() const;

    // One line: "scene.xml: 1994 patches, 2006 unknowns, 64 rays each, seed 0".
    std::string title() const;
    // The program, command, scene, options and sizes.
    nlohmann::ordered_json json() const;

private:
    PatchScene(const PatchOptions& options, std::shared_ptr<const Scene> scene, Processes* processes,
               const std::function<std::unique_ptr<MatrixSystem>(const TracedSettings&)>& make);

    PatchOptions options_;
    ThreadLimit threads_;
    std::shared_ptr<const Scene> scene_;
    std::unique_ptr<MatrixSystem> system_;
};

// The number of channel r, g or b; nothing if the name is empty.
std::optional<int> channel_number(const std::string& name);

}  // namespace neumann
