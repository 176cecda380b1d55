#include "tests/physics/probe.h"

#include <gtest/gtest.h>

#include <limits>

namespace neumann::physics {

void expect_matches(const Statistic& found, double exact, const std::string& what, double largest_error) {
    const double mean = found.mean.r, error = found.standard_error.r, difference = mean - exact;
    if (exact == 0.0) {
        EXPECT_TRUE(mean == 0.0 && error == 0.0) << what << " is " << mean << " ± " << error << " and has to be exactly 0";
        return;
    }
    const double rounding = 0x1p17 * std::numeric_limits<double>::epsilon() * std::abs(exact);
    EXPECT_LE(std::abs(difference), z_limit * error + rounding)
        << what << " is " << mean << " ± " << error << ", exactly " << exact << ": z = " << difference / error;
    EXPECT_LE(error, largest_error * std::abs(exact))
        << what << " is " << mean << " ± " << error << ", which is " << error / std::abs(exact) << " of the reference: no power";
}

void expect_matches(const Estimates& found, std::span<const double> exact, int first, double largest_error) {
    for (std::size_t k = 0; k < exact.size(); ++k) {
        const int bounce = first + static_cast<int>(k);
        expect_matches(found.terms.at(static_cast<std::size_t>(bounce)), exact[k], "K^" + std::to_string(bounce) + " Le",
                       largest_error);
    }
}

void expect_exact(const Estimates& found, const std::function<Rgb(int)>& exact) {
    for (std::size_t i = 0; i < found.terms.size(); ++i) {
        const Rgb truth = exact(static_cast<int>(i));
        const double allowed = 8.0 * static_cast<double>(i) * std::numeric_limits<double>::epsilon();
        for (int c = 0; c < 3; ++c) {
            EXPECT_LE(std::abs(found.terms[i].mean[c] - truth[c]), allowed) << "K^" << i << " Le, channel " << c;
            EXPECT_EQ(found.terms[i].standard_error[c], 0.0) << "K^" << i << " Le, channel " << c;
        }
    }
}

}  // namespace neumann::physics
