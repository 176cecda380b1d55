// What a sensor with one pixel measures, by several methods, against what is known.
#pragma once

#include "operators/render/methods/render.h"
#include "tests/physics/scene_maker.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace neumann::physics {

inline Film one_pixel() { return {1, 1, 0, 0, 1, 1, GaussianFilter()}; }

// Of paths each replicate has 32 samples, as in renders by the commands: in a single pixel larger nets have few ways to combine
// paths from both ends, and 64 of them are too few for their errors. Where each replicate has fields or points of its own there
// are 64.
inline BounceSeries measure(const Scene& scene, const Method& method, std::size_t bounces, std::uint64_t samples) {
    const bool prepares = has_fields(method) || std::holds_alternative<method::Corrected>(method);
    const auto replicates = static_cast<std::uint32_t>(prepares ? 64 : std::max<std::uint64_t>(samples / 32, 4));
    return render(scene, method,
                  {.bounces = static_cast<int>(bounces), .samples = samples, .replicates = replicates, .seed = fixed_seed});
}

// |z| ≤ 4.5 for each bounce, which is a false alarm in at most 3.0e-5 of all comparisons (Student's t of 64 replicates), or exactly
// 0; the standard error is at most `power` of the value. `discretised`: the part by which fields on patches may be off.
inline void expect_measured(const Scene& scene, std::span<const Method> methods, std::span<const double> exact,
                            std::uint64_t samples, double power = 0.01, double discretised = 0.0) {
    for (const Method& method : methods) {
        const BounceSeries found = measure(scene, method, exact.size() - 1, samples);
        for (std::size_t i = 0; i < exact.size(); ++i) {
            SCOPED_TRACE(std::string(name_of(method)) + ", bounce " + std::to_string(i));
            const MeanWithError& m = found.report.bounces[i].mean;
            if (exact[i] == 0.0) {
                EXPECT_EQ(m.mean, 0.0);
                continue;
            }
            const double other = has_fields(method) ? discretised : 1e-12;
            EXPECT_LE(std::abs(m.mean - exact[i]), 4.5 * m.standard_error + other * exact[i])
                << m.mean << " ± " << m.standard_error << ", exact " << exact[i];
            EXPECT_LE(m.standard_error, power * exact[i]);
        }
    }
}

// The same with the figures of the first method in place of known ones: |z| of the differences.
inline void expect_agreement(const Scene& scene, std::span<const Method> methods, std::size_t bounces, std::uint64_t samples,
                             double power = 0.01, double discretised = 0.0) {
    const BounceSeries first = measure(scene, methods.front(), bounces, samples);
    for (const Method& method : methods.subspan(1)) {
        const BounceSeries found = measure(scene, method, bounces, samples);
        for (std::size_t i = 0; i <= bounces; ++i) {
            SCOPED_TRACE(std::string(name_of(method)) + ", bounce " + std::to_string(i));
            const MeanWithError &a = first.report.bounces[i].mean, &b = found.report.bounces[i].mean;
            const double error = std::hypot(a.standard_error, b.standard_error), other = has_fields(method) ? discretised : 1e-12;
            EXPECT_LE(std::abs(a.mean - b.mean), 4.5 * error + other * a.mean) << a.mean << " and " << b.mean << " ± " << error;
            EXPECT_LE(error, power * a.mean);
        }
    }
}

}  // namespace neumann::physics
