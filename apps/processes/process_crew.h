// Other processes as the crew of a render, directed by messages.
#pragma once

#include "apps/processes/scene_on_disk.h"
#include "core/base/processes/processes.h"
#include "operators/render/methods/crew.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

namespace neumann {

class ProcessCrew : public Crew {
public:
    // `threads`: of each process; 0 for all that it may use.
    ProcessCrew(Processes& processes, SceneOnDisk scene, int threads)
        : processes_(processes), scene_(std::move(scene)), threads_(threads) {}

    std::unique_ptr<Helpers> begin(const RecordedRender& render, const std::optional<glm::dmat3>& colors) override;
    std::unique_ptr<FieldTeam> begin_fields(const Method& method) override;

private:
    Processes& processes_;
    SceneOnDisk scene_;
    int threads_;
    std::uint64_t number_ = 0;  // number of the present work, by which late replies to earlier work are recognised
};

}  // namespace neumann
