// Compares what a scene answers with what is known.
//
// The policy of CONTRIBUTING.md: a value passes at |z| ≤ 4.5, and the standard error has to be at most 0.2% of the reference. With
// the 63 degrees of freedom of 64 batches |z| > 4.5 is a false alarm in 3.0e-5 of all comparisons (Student's t; 6.8e-6 for a normal
// z). The whole of this folder makes about 1500 of them: 4% for a new seed, and none with the fixed one.
#pragma once

#include "operators/experiments/known/probe.h"
#include "tests/physics/seed.h"

#include <functional>
#include <span>
#include <string>

namespace neumann::physics {

using namespace known;

constexpr double z_limit = 4.5;
constexpr double power = 0.002;  // the largest standard error, relative to the reference
// A value that is exactly zero has to be found as exactly zero, everything else as said above. Rounding may add n ε, for a mean of
// n samples is rounded n times; no batch has more than 2^17.
void expect_matches(const Statistic& found, double exact, const std::string& what, double largest_error = power);
// `exact[k]` belongs to K^{first+k} Le. First channel.
void expect_matches(const Estimates& found, std::span<const double> exact, int first = 0, double largest_error = power);

// Samples without variance: |K^i Le − exact| ≤ 8 i ε, standard error exactly 0. All channels.
void expect_exact(const Estimates& found, const std::function<Rgb(int)>& exact);

}  // namespace neumann::physics
