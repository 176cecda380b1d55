// What a method says of a scene, as numbers that can be compared: for each bounce and the rest the means of the picture, of its
// channels and of its quarters.
#pragma once

#include "operators/render/methods/bounce_series.h"

#include <array>
#include <string>
#include <vector>

namespace neumann::search {

struct Claim {
    MeanWithError mean;
    double bias = 0.0;   // stated
    double unmet = 0.0;  // no sample met anything, and this is the stated upper bound (95%)
    bool holds = true;   // the method states an interval that it believes
};

struct Measured {
    static constexpr std::size_t parts = 8;  // all, three channels, four quarters
    std::string method;
    bool misses_paths = false;                      // by its own words, so that its means are lower bounds
    double samples = 0.0;                           // of all pixels
    std::vector<std::array<Claim, parts>> bounces;  // 0 … N, and the rest if it was measured
    std::string not_finite = "";                    // what is not, in words
};

std::string name_of_part(std::size_t part);

Measured measure(const std::string& method, const BounceSeries& series);

struct Difference {
    std::size_t bounce = 0, part = 0;
    double probability = 1.0;  // of a difference as large as this or larger, if both are right
};

// The least likely difference of the two.
Difference compare(const Measured& a, const Measured& b);

}  // namespace neumann::search
