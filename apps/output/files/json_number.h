// Converts a number to JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <cmath>

namespace neumann {

// Infinity and NaN become null, because JSON has neither.
inline nlohmann::ordered_json json_number(double x) {
    return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
}

}  // namespace neumann
