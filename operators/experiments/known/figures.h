// Expected and measured values, with their tolerances.
//
// Sampled values pass at |z| = |measured − expected| / SE ≤ 4.5, and only if SE is at most 0.2% of the expected value: without
// power a pass says nothing. With the 63 degrees of freedom of 64 batches, |z| > 4.5 is a false alarm in 3.0e-5 of all comparisons
// (Student's t). If the variance is infinite, z means nothing; cases then check known properties of the samples instead.
#pragma once

#include "operators/experiments/known/probe.h"

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace neumann::known {

inline constexpr double eps = std::numeric_limits<double>::epsilon(), infinity = std::numeric_limits<double>::infinity();
inline constexpr double z_limit = 4.5;
inline constexpr double largest_relative_error = 0.002;  // of a sampled value: its standard error divided by the expected value

struct Figure {
    enum class Relation { equal, at_most, at_least };
    using Value = std::variant<double, std::string>;

    std::string quantity;
    Value expected, measured;
    Relation relation = Relation::equal;
    // |measured − expected| and its limit. Not numbers if words are compared, or if the expected value is itself a limit.
    double error = std::numeric_limits<double>::quiet_NaN();
    double tolerance = std::numeric_limits<double>::quiet_NaN();
    std::optional<double> standard_error = {};
    bool passed = false;
    std::string why = {};  // the reason of a failure, if the numbers do not show it
};

class Figures {
public:
    // Passes if |measured − expected| ≤ tolerance.
    void near(std::string quantity, double measured, double expected, double tolerance);
    // Compares the first channel. The tolerance is 4.5 SE plus rounding plus `bias`, the known error of `expected`. If 0 is
    // expected, exactly 0 must be found.
    void sampled(std::string quantity, const Statistic& found, double expected, double bias = 0.0);
    // sampled() for K^first Le, K^(first+1) Le, …
    void terms(const Estimates& found, std::span<const double> expected, int first = 1, double bias = 0.0);
    void at_most(std::string quantity, double measured, double limit);
    void at_least(std::string quantity, double measured, double limit);
    void equal(std::string quantity, std::string measured, std::string expected);
    void holds(std::string quantity, bool holds);
    void fail(std::string quantity, std::string why);

    const std::vector<Figure>& all() const { return all_; }

private:
    std::vector<Figure> all_;
};

}  // namespace neumann::known
