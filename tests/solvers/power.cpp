#include "operators/algebra/term_series.h"
#include "operators/experiments/known/cube.h"

#include <gtest/gtest.h>

namespace neumann::power_test {

using namespace known;

// Closed and diffuse: power falls by ρ a bounce, whatever is emitted; and with any ρ what is absorbed, (1−ρ)/ρ K^i Le, adds up to
// what was emitted.
TEST(Power, IsConserved) {
    const Cube cube = patched_cube(8);
    const Vector rho = cube.on_faces({.2, .5, .8, .9, .95, .7});
    const DenseChannel K7 = cube.channel(0.7), K = cube.channel(rho);
    TermSeries even(K7, cube.ceiling()), mixed(K, cube.ceiling());
    double absorbed = 0.0;
    for (int i = 1; i <= 100; ++i) {
        even.advance();
        mixed.advance();
        EXPECT_NEAR(norms(even.term(), K7.measure()).power, std::pow(0.7, i), 1e-13 * std::pow(0.7, i));
        absorbed += ((1.0 - rho.array()) / rho.array() * mixed.term().array() * cube.factors.area.array()).sum();
    }
    EXPECT_NEAR(absorbed, 1.0, 1e-13);
}

}  // namespace neumann::power_test
