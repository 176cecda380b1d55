#include "operators/experiments/known/figures.h"

#include <fmt/format.h>
#include <cmath>

namespace neumann::known {

void Figures::near(std::string quantity, double measured, double expected, double tolerance) {
    Figure f{std::move(quantity), expected, measured};
    f.error = std::abs(measured - expected);
    f.tolerance = tolerance;
    f.passed = f.error <= tolerance;
    all_.push_back(std::move(f));
}

void Figures::sampled(std::string quantity, const Statistic& found, double expected, double bias) {
    const double mean = found.mean.r, error = found.standard_error.r;
    // A mean of n samples is rounded n times; no batch has more than 2^17.
    const double rounding = 0x1p17 * std::numeric_limits<double>::epsilon() * std::abs(expected);
    near(std::move(quantity), mean, expected, expected == 0.0 ? 0.0 : z_limit * error + rounding + bias);
    Figure& f = all_.back();
    f.standard_error = error;
    const double relative = error / std::abs(expected);
    if (expected != 0.0 && !(relative <= largest_relative_error)) {
        f.passed = false;
        f.why = fmt::format("no power: the standard error is {:.2g}% of what is expected", 100.0 * relative);
    } else if (!f.passed && error > 0.0) {
        f.why = fmt::format("z = {:.2f}", (mean - expected) / error);
    }
}

void Figures::terms(const Estimates& found, std::span<const double> expected, int first, double bias) {
    for (std::size_t k = 0; k < expected.size(); ++k) {
        const std::size_t bounce = static_cast<std::size_t>(first) + k;
        sampled(fmt::format("K^{} Le", bounce), found.terms.at(bounce), expected[k], bias);
    }
}

void Figures::at_most(std::string quantity, double measured, double limit) {
    all_.push_back({std::move(quantity), limit, measured, Figure::Relation::at_most});
    all_.back().passed = measured <= limit;
}

void Figures::at_least(std::string quantity, double measured, double limit) {
    all_.push_back({std::move(quantity), limit, measured, Figure::Relation::at_least});
    all_.back().passed = measured >= limit;
}

void Figures::equal(std::string quantity, std::string measured, std::string expected) {
    const bool same = measured == expected;
    all_.push_back({std::move(quantity), std::move(expected), std::move(measured)});
    all_.back().passed = same;
}

void Figures::holds(std::string quantity, bool holds) { equal(std::move(quantity), holds ? "yes" : "no", "yes"); }

void Figures::fail(std::string quantity, std::string why) {
    all_.push_back({std::move(quantity), "an answer", "none"});
    all_.back().why = std::move(why);
}

}  // namespace neumann::known
