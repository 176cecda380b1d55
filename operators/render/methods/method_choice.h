// The reason why --method auto took a method.
#pragma once

#include "operators/render/methods/method.h"

#include <string>
#include <vector>

namespace neumann {

struct MethodTrial {
    std::string method;
    double rays = 0.0;   // per camera sample, without those before the first sample
    double error = 0.0;  // relative, of all bounces together: √Σ_i E|error of K^i Le|² / |K^i Le|²
};

struct MethodChoice {
    Method method;
    std::string why;                       // in words
    std::vector<MethodTrial> trials = {};  // empty if there was nothing to choose, or too little to gain
    double seconds = 0.0;
};

}  // namespace neumann
