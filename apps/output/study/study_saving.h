// The state of a study's present run, or of its reference, while that is rendered.
#pragma once

#include "apps/output/files/checkpoints.h"
#include "apps/output/files/output_folder.h"
#include "apps/requests/study_request.h"
#include "core/scene/scene.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>

namespace neumann {

class StudySaving {
public:
    // `run`: the number of the run, or "reference".
    StudySaving(OutputFolder& folder, const nlohmann::ordered_json& run, const Scene& scene, const StudyRequest& request)
        : folder_(folder),
          what_{{"run", run}},
          checkpoints_(folder, {what_, scene.hash}, "the same command with --resume", request.checkpoint, false,
                       [](const std::string&) {}) {}

    // Whether the folder has no state of another run.
    bool has_room() const { return !std::filesystem::exists(folder_.saved()) || is_there(); }
    // The callbacks of a run, which continues its state if there is one. They refer to this object.
    Saving saving() { return checkpoints_.saving(is_there() ? std::optional(read_saved_render(folder_.saved())) : std::nullopt); }

private:
    bool is_there() const { return std::filesystem::exists(folder_.saved()) && request_in_file(folder_.saved()).request == what_; }

    OutputFolder& folder_;
    nlohmann::ordered_json what_;
    Checkpoints checkpoints_;
};

}  // namespace neumann
