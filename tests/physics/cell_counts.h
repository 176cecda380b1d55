// Pearson's χ² of samples that were counted in cells.
#pragma once

#include <boost/math/distributions/chi_squared.hpp>

namespace neumann {

class CellCounts {
public:
    // The counts of cells where fewer are expected are not near enough to normal ones: they are kept apart, together.
    static constexpr double fewest = 10.0;

    void add(double found, double expected) {
        all_expected += expected;
        if (expected < fewest) {
            few_found += found;
            few_expected += expected;
        } else {
            compare(found, expected);
        }
    }
    // Makes a cell of those that were kept apart, if enough are expected of them together. Returns whether they were.
    bool join_few() {
        if (few_expected < fewest) return false;
        compare(few_found, few_expected);
        return true;
    }
    // The chance of a larger χ².
    double p() const { return cdf(complement(boost::math::chi_squared(cells - 1), chi2)); }

    double chi2 = 0.0, few_found = 0.0, few_expected = 0.0, all_expected = 0.0;
    int cells = 0;

private:
    void compare(double found, double expected) {
        chi2 += (found - expected) * (found - expected) / expected;
        ++cells;
    }
};

}  // namespace neumann
