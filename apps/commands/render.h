// `neumann render`: a scene in, its bounce pictures out.
#pragma once

#include "apps/rendering/light_options.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct RenderRequest {
    std::string scene;
    std::vector<std::string> definition_texts;       // -D name=value, as typed
    std::map<std::string, std::string> definitions;  // likewise, read
    std::string output;                              // a folder; empty: out/NAME
    std::optional<int> bounces;
    std::optional<double> tail;
    std::optional<std::uint64_t> samples;
    std::optional<double> seconds;
    std::optional<double> relative_error;
    std::optional<double> memory;  // GiB
    std::string method = "walk";
    LightOptions light;
    std::optional<int> ways;    // of bidirectional: the bounce of which every way is shown
    std::string plan = "auto";  // or full: nothing is left out
    std::string sampler;        // sobol or independent; empty: the scene's
    bool importance = false;    // of patches: pictures of K*^i We
    std::optional<std::size_t> patches;
    std::optional<std::uint32_t> directions;
    std::string reference;  // a folder of an earlier render, or empty
    std::uint64_t seed = 0;
    bool only_pictures = false;  // neither the rest nor the errors at fewer samples are wanted
    int threads = 0;             // 0: all
    bool quiet = false;
    bool json = false;
    std::string command_line;  // as typed, for run.json
};

// Exit code 0, also when Ctrl-C ended it early. Throws InputError and RunError.
int render_command(const RenderRequest& request);

}  // namespace neumann
