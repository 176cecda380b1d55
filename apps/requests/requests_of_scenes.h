// The requests of commands that render no picture of a scene, or many.
#pragma once

#include "apps/requests/option.h"
#include "apps/requests/scene_file.h"
#include "operators/experiments/known/cases.h"

namespace neumann {

struct PlanRequest {
    SceneFile scene;
    bool json = false;
};

const Options<PlanRequest>& plan_options();

struct ConvertRequest {
    SceneFile scene;
    std::string output;
    bool quiet = false;
};

const Options<ConvertRequest>& convert_options();

struct ConformRequest {
    std::string folder;
    std::string only;  // only scenes whose path contains this
    std::string output = "out/conform";
    std::uint64_t budget = 2'000'000;  // total samples per scene, over all pixels
    std::uint64_t seed = 0;
    int threads = 0;  // 0: all
    bool json = false;
};

const Options<ConformRequest>& conform_options();

struct StressRequest {
    std::string only;  // part of the names of cases; empty: all cases
    std::uint64_t seed = known::default_seed;
    int threads = 0;  // 0: all
    bool list = false, json = false;
};

const Options<StressRequest>& stress_options();

}  // namespace neumann
