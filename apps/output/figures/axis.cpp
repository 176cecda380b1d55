#include "apps/output/figures/axis.h"

#include "apps/output/sheets/superscript.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace neumann {

namespace {

std::string power_of_ten(int digit, int exponent) {
    if (std::abs(exponent) <= 2) return fmt::format("{:g}", digit * std::pow(10.0, exponent));
    return fmt::format("{}10{}{}", digit == 1 ? "" : fmt::format("{}·", digit), exponent < 0 ? "⁻" : "",
                       superscript(static_cast<std::size_t>(std::abs(exponent))));
}

}  // namespace

Axis Axis::logarithmic(double least, double most) {
    const double middle = std::log10(least) / 2.0 + std::log10(most) / 2.0;
    const double half = std::max(1.1 * (std::log10(most) - std::log10(least)), std::log10(4.0)) / 2.0;
    return {true, middle - half, middle + half};
}

Axis Axis::of_whole_numbers(double most) { return {false, -0.4, std::max(most, 1.0) + 0.4}; }

double Axis::place(double value) const { return ((is_logarithmic_ ? std::log10(value) : value) - low_) / (high_ - low_); }

std::vector<Tick> Axis::ticks(double space) const {
    if (is_logarithmic_) return decades(space);
    double step = 1.0;
    for (double next = 1.0; step < space * (high_ - low_); next *= 10.0)
        for (const double digit : {1.0, 2.0, 5.0})
            if (step < space * (high_ - low_)) step = digit * next;
    std::vector<Tick> ticks;
    for (double value = 0.0; value <= high_; value += step) ticks.push_back({value, fmt::format("{:g}", value)});
    return ticks;
}

// The decades have labels first, then their doubles and fives, and then the others, where there is room.
std::vector<Tick> Axis::decades(double space) const {
    std::vector<Tick> ticks;
    std::vector<double> taken;
    const int least = static_cast<int>(std::floor(low_)), most = static_cast<int>(std::floor(high_));
    const auto add = [&](std::initializer_list<int> digits, std::size_t enough) {
        const bool has_room = taken.size() < enough;
        for (int exponent = least; exponent <= most; ++exponent)
            for (const int digit : digits) {
                const double value = digit * std::pow(10.0, exponent), at = place(value);
                if (at < 0.0 || at > 1.0) continue;
                const bool is_free = std::ranges::all_of(taken, [&](double other) { return std::abs(at - other) >= space; });
                ticks.push_back({value, has_room && is_free ? power_of_ten(digit, exponent) : ""});
                if (!ticks.back().label.empty()) taken.push_back(at);
            }
    };
    add({1}, 1000);
    add({2, 5}, 3);
    add({3, 4, 6, 7, 8, 9}, 2);
    return ticks;
}

}  // namespace neumann
