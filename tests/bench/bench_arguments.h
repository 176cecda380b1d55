// What benchmarks of whole scenes are called with: [RESOLUTION [SAMPLES]] [SCENE.xml …].
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace neumann {

struct BenchArguments {
    std::string resolution;
    std::uint32_t samples;
    std::vector<std::string> paths;  // seven scenes that come along, if none are given

    BenchArguments(int argc, char** argv, std::string usual_resolution, std::uint32_t usual_samples)
        : resolution(argc > 1 ? argv[1] : std::move(usual_resolution)),
          samples(argc > 2 ? static_cast<std::uint32_t>(std::stoul(argv[2])) : usual_samples),
          paths(argv + std::min(argc, 3), argv + argc) {
        if (!paths.empty()) return;
        for (const char* name :
             {"cornell-box", "door-ajar", "floating-panels", "glossy-floor", "metal-room", "glass-ball", "outdoor"})
            paths.push_back(fmt::format("{}/{}/{}.xml", SCENES, name, name));
    }
};

}  // namespace neumann
