// A number in JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <cmath>

namespace neumann {

// JSON has no infinity: null.
inline nlohmann::ordered_json json_number(double x) {
    return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
}

}  // namespace neumann
