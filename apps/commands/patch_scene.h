// Shared by the commands that treat a scene as matrices: their options, and the construction of space, table, R and channels.
#pragma once

#include "core/base/limits.h"
#include "core/base/processes/processes.h"
#include "core/base/warnings.h"
#include "operators/fields/matrix/traced_system.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct PatchOptions {
    std::string scene;
    std::vector<std::string> definitions;  // -D name=value
    bool lenient = false;
    std::uint64_t patches = 2000;
    std::uint64_t rays = 64;  // per facet
    std::uint64_t seed = 0;
    int threads = 0;                  // 0: all
    std::optional<double> memory;     // GiB
    std::optional<std::string> keep;  // folder for the rows of T
    std::optional<double> checkpoint;
    bool quiet = false;
    bool json = false;
    std::string command_line;  // as typed
};

// The scene of a command, read and traced. During its lifetime it limits the number of threads.
class PatchScene {
public:
    // Throws InputError that names the wrong option or scene, and what is allowed, and Stopped at Ctrl-C.
    explicit PatchScene(const PatchOptions& options);
    // For processes that share it, all together; `petsc`: SLEPc's options.
    PatchScene(const PatchOptions& options, Processes& processes, const std::string& petsc);
    // Uses a scene that was read before, with these definitions.
    PatchScene(const PatchOptions& options, std::shared_ptr<const Scene> scene, std::map<std::string, std::string> definitions);

    const Scene& scene() const { return *scene_; }
    const MatrixSystem& system() const { return *system_; }
    // Of one process alone.
    const TracedSystem& traced() const { return dynamic_cast<const TracedSystem&>(*system_); }

    // "", or "r", "g", "b", as in names of files.
    const char* channel_letter(int c) const;

    std::vector<std::string> warnings() const;

    // One line: "scene.xml: 1994 patches, 2006 unknowns, 64 rays each, seed 0".
    std::string title() const;
    // Program, command, scene, options and sizes.
    nlohmann::ordered_json json() const;

private:
    PatchScene(const PatchOptions& options, std::shared_ptr<const Scene> scene, std::map<std::string, std::string> definitions,
               Processes* processes, const std::function<std::unique_ptr<MatrixSystem>(const TracedSettings&)>& make);

    PatchOptions options_;
    ThreadLimit threads_;
    std::map<std::string, std::string> definitions_;
    std::shared_ptr<const Scene> scene_;
    std::unique_ptr<MatrixSystem> system_;
};

// The channel that --channel names: r, g or b; nothing if the name is empty. Throws InputError.
std::optional<int> channel_number(const std::string& name);

}  // namespace neumann
