// Which parts of the program a scene needs, found from the scene before anything runs. Parts that it does not need are left out.
// This does not change the expected picture; except for LeftOut::questions, it changes no bit of the picture.
//
// The cases are listed in plan.cpp.
#pragma once

#include "core/scene/scene.h"
#include "operators/paths/walk/left_out.h"

#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct PlanPart {
    std::string part;    // the name of the part
    bool kept;           // the scene needs it, or it is not proven unnecessary
    std::string reason;  // why it is kept or left out
    std::string saves;   // what leaving it out saves; empty if it is kept
    // The flag of LeftOut that walks need for this part, if any.
    bool LeftOut::*decision = nullptr;
};

struct Plan {
    std::vector<PlanPart> parts;
    LeftOut walk;
    // The materials of the sides of shapes, with sides that no light reaches made absorbing; empty if there are no such sides.
    std::vector<Materials::Sides> sides = {};
};

Plan make_plan(const Scene& scene);
// The name of the only part that does not depend on the scene: it is kept if the user asks for roulette.
inline constexpr const char* roulette_part = "roulette before the last picture";

// The scene without materials on sides that no light reaches, according to the plan; nothing if there are no such sides. It shares
// geometry and lights with `scene`.
std::optional<Scene> without_unlit_materials(const Plan& plan, const Scene& scene);

}  // namespace neumann
