// What a scene needs of the machinery, found by one look at it before anything runs. What it does not need is left out, which
// changes no expected picture, and but for the questions for light no bit of one.
//
// A case is one entry of the list in plan.cpp.
#pragma once

#include "core/scene/scene.h"
#include "operators/walk/left_out.h"

#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct PlanPart {
    std::string part;    // of the machinery
    bool kept;           // the scene needs it, or nothing is known that would spare it
    std::string reason;  // as found in the scene
    std::string saves;   // by leaving it out; empty where it is kept
    // What walks are told, where that is more than not to meet it.
    bool LeftOut::*decision = nullptr;
};

struct Plan {
    std::vector<PlanPart> parts;
    LeftOut walk;
    // What stands on the sides of shapes, where those that no light reaches absorb; empty where there are none.
    std::vector<Materials::Sides> sides = {};
};

Plan make_plan(const Scene& scene);
// The part that is no property of the scene: who asks for it keeps it.
inline constexpr const char* roulette_part = "roulette before the last picture";

// The scene without materials where no light arrives, as the plan says; nothing where there are none. Its geometry and its lights
// are those of `scene`, shared.
std::optional<Scene> without_unlit_materials(const Plan& plan, const Scene& scene);

}  // namespace neumann
