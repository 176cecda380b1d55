// What was expected and what was found, figure by figure, and how far both may be apart.
//
// Sampled values pass at |z| = |measured − expected| / SE ≤ 4.5, and only if SE is at most 0.2% of what is expected: without power
// a pass says nothing. With the 63 degrees of freedom of 64 batches, |z| > 4.5 is a false alarm in 3.0e-5 of all comparisons
// (Student's t). Where the variance is infinite z means nothing, and what is known of the samples is looked at instead.
#pragma once

#include "operators/known/probe.h"

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace neumann::known {

inline constexpr double eps = std::numeric_limits<double>::epsilon(), infinity = std::numeric_limits<double>::infinity();
inline constexpr double z_limit = 4.5;
inline constexpr double largest_relative_error = 0.002;  // of a sampled value: its standard error over what is expected

struct Figure {
    enum class Relation { equal, at_most, at_least };
    using Value = std::variant<double, std::string>;

    std::string quantity;
    Value expected, measured;
    Relation relation = Relation::equal;
    // |measured − expected| and what it may be; not numbers where words are compared or a limit is kept.
    double error = std::numeric_limits<double>::quiet_NaN();
    double tolerance = std::numeric_limits<double>::quiet_NaN();
    std::optional<double> standard_error = {};
    bool passed = false;
    std::string why = {};  // of a failure, where the numbers do not tell
};

class Figures {
public:
    // |measured − expected| ≤ tolerance.
    void near(std::string quantity, double measured, double expected, double tolerance);
    // The tolerance is 4.5 SE, rounding, and `bias`: what is known to be wrong with `expected`. What is expected to be 0 has to be
    // exactly that. First channel.
    void sampled(std::string quantity, const Statistic& found, double expected, double bias = 0.0);
    // Of K^first Le, K^(first+1) Le, …
    void terms(const Estimates& found, std::span<const double> expected, int first = 1, double bias = 0.0);
    void at_most(std::string quantity, double measured, double limit);
    void at_least(std::string quantity, double measured, double limit);
    // The same words.
    void said(std::string quantity, std::string measured, std::string expected);
    // What ought to be true; `measured` says what was found instead.
    void holds(std::string quantity, bool holds);
    void fail(std::string quantity, std::string why);

    const std::vector<Figure>& all() const { return all_; }

private:
    std::vector<Figure> all_;
};

}  // namespace neumann::known
