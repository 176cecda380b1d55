// The table of metals against the measurements that it comes from.
#include "core/image/colour/metals.h"

#include "core/image/colour/spectrum_to_rgb.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::metals_test {

// luxpop.com, as in Mitsuba's ior/Ag.eta.spd, Ag.k.spd, Au.eta.spd and Au.k.spd; silver and gold at the same wavelengths.
const std::vector<double> wavelengths = {
    298.757,  302.4004, 306.1338, 309.9604, 313.884,  317.9081, 322.0368, 326.2741, 330.6245, 335.0924, 339.6827, 344.4005,
    349.2512, 354.2405, 359.3744, 364.6593, 370.102,  375.7096, 381.4898, 387.4506, 393.6006, 399.949,  406.5055, 413.2806,
    420.2853, 427.5316, 435.0322, 442.8006, 450.8516, 459.2007, 467.8648, 476.8622, 486.2125, 495.9367, 506.0579, 516.6008,
    527.5922, 539.0616, 551.0408, 563.5645, 576.6706, 590.4008, 604.8008, 619.9209, 635.8163, 652.5483, 670.1848, 688.801,
    708.481,  729.3187, 751.4193, 774.9011, 799.8979, 826.5612, 855.0633, 885.6013};
const std::vector<double> silver_eta = {
    1.519,    1.496, 1.4325,   1.323, 1.142062, 0.932, 0.719062, 0.526, 0.388125, 0.294, 0.253313, 0.238, 0.221438, 0.209,
    0.194813, 0.186, 0.192063, 0.2,   0.198063, 0.192, 0.182,    0.173, 0.172625, 0.173, 0.166688, 0.16,  0.1585,   0.157,
    0.151063, 0.144, 0.137313, 0.132, 0.13025,  0.13,  0.129938, 0.13,  0.130063, 0.129, 0.124375, 0.12,  0.119313, 0.121,
    0.1255,   0.131, 0.136125, 0.14,  0.140063, 0.14,  0.144313, 0.148, 0.145875, 0.143, 0.142563, 0.145, 0.151938, 0.163};
const std::vector<double> silver_k = {
    1.08,    0.882, 0.761063, 0.647, 0.550875, 0.504, 0.554375, 0.663, 0.818563, 0.986, 1.120687, 1.24, 1.34525,  1.44,
    1.53375, 1.61,  1.641875, 1.67,  1.735,    1.81,  1.87875,  1.95,  2.029375, 2.11,  2.18625,  2.26, 2.329375, 2.4,
    2.47875, 2.56,  2.64,     2.72,  2.798125, 2.88,  2.97375,  3.07,  3.159375, 3.25,  3.348125, 3.45, 3.55375,  3.66,
    3.76625, 3.88,  4.010625, 4.15,  4.293125, 4.44,  4.58625,  4.74,  4.908125, 5.09,  5.28875,  5.5,  5.720624, 5.95};
const std::vector<double> gold_eta = {
    1.795,    1.812, 1.822625, 1.83,  1.837125, 1.84,  1.83425,  1.824, 1.812,   1.798, 1.782,    1.766, 1.7525,   1.74,
    1.727625, 1.716, 1.705875, 1.696, 1.68475,  1.674, 1.666,    1.658, 1.64725, 1.636, 1.628,    1.616, 1.59625,  1.562,
    1.502125, 1.426, 1.345875, 1.242, 1.08675,  0.916, 0.7545,   0.608, 0.49175, 0.402, 0.3455,   0.306, 0.267625, 0.236,
    0.212375, 0.194, 0.17775,  0.166, 0.161,    0.16,  0.160875, 0.164, 0.1695,  0.176, 0.181375, 0.188, 0.198125, 0.21};
const std::vector<double> gold_k = {
    1.920375, 1.92,  1.918875, 1.916, 1.911375, 1.904, 1.891375, 1.878, 1.86825,  1.86,  1.85175,  1.846, 1.84525,  1.848,
    1.852375, 1.862, 1.883,    1.906, 1.9225,   1.936, 1.94775,  1.956, 1.959375, 1.958, 1.951375, 1.94,  1.9245,   1.904,
    1.875875, 1.846, 1.814625, 1.796, 1.797375, 1.84,  1.9565,   2.12,  2.32625,  2.54,  2.730625, 2.88,  2.940625, 2.97,
    3.015,    3.06,  3.07,     3.15,  3.445812, 3.8,   4.087687, 4.357, 4.610188, 4.86,  5.125813, 5.39,  5.63125,  5.88};

const Metal& metal(std::string_view name) {
    return *std::find_if(metals().begin(), metals().end(), [&](const Metal& m) { return m.name == name; });
}

TEST(Metals, AreTheMeasuredSpectraUnderEqualEnergy) {
    const auto check = [](const Rgb& found, const std::vector<double>& values) {
        const Rgb exact = spectrum_to_rgb({wavelengths, values}, Illuminant::equal_energy);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], exact[c], 2e-5);
    };
    check(metal("Ag").eta, silver_eta);
    check(metal("Ag").k, silver_k);
    check(metal("Au").eta, gold_eta);
    check(metal("Au").k, gold_k);
}

// What another program that follows Mitsuba's sum has for silver.
TEST(Metals, SilverIsMitsubas) {
    const Rgb eta(0.155276, 0.116728, 0.138388), k(4.828354, 3.122222, 2.146901);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(metal("Ag").eta[c], eta[c], 1e-4);
        EXPECT_NEAR(metal("Ag").k[c], k[c], 1e-4);
    }
}

TEST(Metals, AreSortedAndReal) {
    EXPECT_EQ(metals().size(), 71u);
    EXPECT_TRUE(std::is_sorted(metals().begin(), metals().end(), [](const Metal& a, const Metal& b) { return a.name < b.name; }));
    for (const Metal& m : metals())
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(m.eta[c], 0.0) << m.name;
            EXPECT_GE(m.k[c], 0.0) << m.name;
        }
}

}  // namespace neumann::metals_test
