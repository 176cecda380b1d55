// The parts of the program that a scene needs, found from the scene before anything runs. Other parts are left out. This does not
// change the expected picture; except for LeftOut::light_samples, it changes no bit of the picture. The cases are listed in
// plan.cpp.
#pragma once

#include "core/scene/scene.h"
#include "operators/paths/walk/left_out.h"

#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct PlanPart {
    std::string part;    // the name of the part
    bool kept;           // whether the scene needs it, or it is not proven unnecessary
    std::string reason;  // why it is kept or left out
    std::string saves;   // the saving if it is left out; empty if it is kept
    // The flag of LeftOut by which walks leave this part out, if any.
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
