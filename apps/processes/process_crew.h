// Other processes as the crew of a render, told by messages what to do.
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
    // `threads`: of each; 0 for all that are its own.
    ProcessCrew(Processes& processes, SceneOnDisk scene, int threads)
        : processes_(processes), scene_(std::move(scene)), threads_(threads) {}

    std::unique_ptr<Helpers> begin(const RecordedRender& render, const std::optional<glm::dmat3>& colors) override;
    std::unique_ptr<FieldTeam> begin_fields(const Method& method) override;

private:
    Processes& processes_;
    SceneOnDisk scene_;
    int threads_;
    std::uint64_t number_ = 0;  // of the present work, so that late answers to earlier work are known as such
};

}  // namespace neumann
