// The health part of run.json, and what is said of it where something is sick.
#pragma once

#include "operators/methods/bounce_series.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace neumann {

// What is sick and where, a line each; `folder`: for how to replay it.
std::vector<std::string> complaints(const Health& health, const Scene& scene, const std::string& folder);

nlohmann::ordered_json as_json(const Health& health, const Scene& scene, const std::string& folder);

// The same of fields on patches, which have no samples to replay.
std::vector<std::string> complaints(const EnergyBalance& power);
nlohmann::ordered_json as_json(const EnergyBalance& power);

// Of either; null where the render was not looked at.
nlohmann::ordered_json health_json(const BounceSeries& series, const Scene& scene, const std::string& folder);

// Where a shape comes from: "shape 'cube' of bsdf 'diffuse', scene.xml:12:5".
std::string name_of_shape(const Scene& scene, std::uint32_t shape);

}  // namespace neumann
