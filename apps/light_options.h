// --direct, --lights and --roulette: how walks find light, and how they end.
#pragma once

#include "operators/walk/direct_light.h"
#include "operators/walk/roulette.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace neumann {

struct LightOptions {
    std::string direct, lights, roulette;  // as given; empty where they are not

    bool given() const { return !direct.empty() || !lights.empty() || !roulette.empty(); }
};

void add_light_options(CLI::App& command, LightOptions& options);
// Throws InputError where they are given to a method they do not belong to.
void check_light_options(const LightOptions& options, const std::string& method);
// Throws InputError where lights are chosen that are not asked for, or are out of reach.
DirectLightSettings direct_light(const LightOptions& options, const Emitters& emitters);
Roulette roulette(const LightOptions& options);
// What is given and what is not, as options that say the same.
nlohmann::ordered_json as_json(const LightOptions& options);

}  // namespace neumann
