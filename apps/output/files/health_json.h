// The health part of run.json, and messages about problems.
#pragma once

#include "operators/render/methods/bounce_series.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace neumann {

// Messages, one line each, that report a problem and its place. `folder`: named in the command that replays it.
std::vector<std::string> complaints(const Health& health, const Scene& scene, const std::string& folder);

nlohmann::ordered_json as_json(const Health& health, const Scene& scene, const std::string& folder);

// The same for fields on patches, which have no samples to replay.
std::vector<std::string> complaints(const EnergyBalance& power);
nlohmann::ordered_json as_json(const EnergyBalance& power);

// The samples that a report names, in its order, and why: "bounce 3: largest share of its pixel".
std::vector<std::pair<SampleName, std::string>> named_samples(const Health& health);

// The health of paths or fields; none and null if the render was not checked.
std::vector<std::string> complaints(const BounceSeries& series, const Scene& scene, const std::string& folder);
nlohmann::ordered_json health_json(const BounceSeries& series, const Scene& scene, const std::string& folder);

// A shape's origin: "shape 'cube' of bsdf 'diffuse', scene.xml:12:5".
std::string name_of_shape(const Scene& scene, std::uint32_t shape);

}  // namespace neumann
