// The uncertainty that n samples leave, however well they agree. Stratified samples often meet something equally often
// in all replicates although their expectation lies a little higher, and their spread does not show that. The half
// width of a 95% interval is at least h, with D the largest minus the smallest sample:
//
//     h = 3 D/n   if all replicates agree: the rule of three. The probability p of a sample that differs is below 3/n
//                 with 95% confidence, as (1 − p)^n ≤ e^{−pn} = 0.05
//     h = D/n     otherwise: one sample more or less
#pragma once

#include "operators/statistics/sample_ranges.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace neumann {

constexpr double rule_of_three = 2.995732273553991;  // −ln 0.05
// The tolerances within which replicates agree to rounding, and ranges, which are floats.
constexpr double agreement = 1e-9, rounding_of_ranges = 1e-6;

// D of a channel; 0 if it is no more than rounding.
inline double difference(const SampleRange& range, int c) {
    const double smallest = range.smallest[c], largest = range.largest[c], d = largest - smallest;
    return d > rounding_of_ranges * std::max(std::abs(smallest), std::abs(largest)) ? d : 0.0;
}

inline double least_half_width(double d, double samples, bool agree) { return (agree ? rule_of_three : 1.0) * d / samples; }

// Calls f for the pixel and its eight neighbours.
template <class F>
void for_neighbourhood(int width, int height, std::size_t pixel, const F& f) {
    const int x = static_cast<int>(pixel) % width, y = static_cast<int>(pixel) / width;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
            f(static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u));
}

}  // namespace neumann
