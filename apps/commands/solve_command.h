// `neumann solve SCENE`: compares the series with all other solvers of L = Le + K L.
#pragma once

#include "apps/commands/patch_scene.h"
#include "operators/fields/matrix/channel_choice.h"
#include "operators/solvers/side_by_side.h"

#include <string>
#include <vector>

namespace neumann {

struct SolvedScene {
    ChosenChannel chosen;
    SideBySide all;
    std::vector<std::string> warnings = {};
};
// `histories`: record true errors at each step; `shared`: the scene is shared by several processes. Throws InputError.
SolvedScene solve_scene(const PatchScene& scene, const SolveRequest& request, bool histories, bool shared = false);
nlohmann::ordered_json solve_json(const PatchScene& scene, const SolveRequest& request, const SolvedScene& solved);

// Prints for each solver its cost, its distance from LU, and how it ended. Returns the exit code, 0 whatever the verdicts. Throws
// InputError.
int solve_command(const SolveRequest& request);

}  // namespace neumann
