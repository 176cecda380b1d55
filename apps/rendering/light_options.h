// --direct, --lights, --roulette and --split: how walks find light, how they end, and where they branch.
#pragma once

#include "operators/walk/walk_settings.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct LightOptions {
    std::string direct, lights, roulette, split;  // as given; empty where they are not

    bool given() const { return !direct.empty() || !lights.empty() || !roulette.empty() || !split.empty(); }
};

// What they may be.
std::vector<std::string> names_of_direct();
std::vector<std::string> names_of_lights();
bool is_roulette(const std::string& text);
bool is_split(const std::string& text);

// Throws InputError where they are given to a method they do not belong to.
void check_light_options(const LightOptions& options, const std::string& method);
// Throws InputError where lights are chosen that are not asked for, or are out of reach.
DirectLightSettings direct_light(const LightOptions& options, const Emitters& emitters);
Roulette roulette(const LightOptions& options);
Split split(const LightOptions& options);
// What is given and what is not, as options that say the same.
nlohmann::ordered_json as_json(const LightOptions& options);

}  // namespace neumann
