// `neumann plan`: which parts of the program a scene needs, which are left out, and why.
#pragma once

#include <string>
#include <vector>

namespace neumann {

struct PlanRequest {
    std::string scene;
    std::vector<std::string> definitions;  // -D, as typed
    bool lenient = false;
    bool json = false;
};

// Exit code 0. Throws InputError.
int plan_command(const PlanRequest& request);

}  // namespace neumann
