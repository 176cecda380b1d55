// The processes that render together with this one.
#pragma once

#include "operators/render/from_fields/field_team.h"
#include "operators/render/from_paths/share.h"
#include "operators/render/methods/recorded_render.h"

#include <glm/glm.hpp>

#include <memory>
#include <optional>

namespace neumann {

class Crew {
public:
    virtual ~Crew() = default;
    // Helpers for a render of the scene, which they know already; `colors` as in Goal. They need a while until they are
    // ready, and have nothing to do with earlier renders.
    virtual std::unique_ptr<Helpers> begin(const RecordedRender& render, const std::optional<glm::dmat3>& colors) = 0;
    // The same for a method with fields on patches.
    virtual std::unique_ptr<FieldTeam> begin_fields(const Method& method) = 0;
};

}  // namespace neumann
