// What every material promises: samples that follow their density, and reciprocity; and integrals over the whole sphere.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/experiments/known/quadrature.h"
#include "tests/physics/cell_counts.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::physics {

using namespace known;

// ∫ f(ω) dω over z and φ between bounds: Gauss's rule of 20 × 20 points.
template <class Function>
double over_cell(double from_z, double to_z, double from_phi, double to_phi, const Function& f) {
    using Rule = boost::math::quadrature::gauss<double, 20>;
    return Rule::integrate(
        [&](double z) {
            const double r = std::sqrt(1.0 - z * z);
            return Rule::integrate([&](double phi) { return f(Vec3(r * std::cos(phi), r * std::sin(phi), z)); }, from_phi, to_phi);
        },
        from_z, to_z);
}
// The albedo seen from ωo, reflected and let through, in 8 × 8 cells.
inline double albedo_of_both_sides(const Bsdf& bsdf, const Vec3& wo, int channel) {
    constexpr int n = 8;
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            sum += over_cell(2.0 * i / n - 1.0, 2.0 * (i + 1) / n - 1.0, 2.0 * pi * j / n, 2.0 * pi * (j + 1) / n,
                             [&](const Vec3& wi) { return eval(bsdf, {}, wo, wi)[channel] * std::abs(wi.z); });
    return sum;
}

// The probability of a χ² that is larger than that of 16384 directions in 12 × 24 cells of the sphere, equal in solid angle, and of
// those that are deltas or none at all, whose share is 1 − ∫ pdf.
inline double directions_p_value(const Bsdf& bsdf, const ShadingPoint& p, const Vec3& wo, std::uint32_t stream,
                                 std::uint64_t seed = fixed_seed, int count = 16384) {
    constexpr int rings = 12, sectors = 24;
    std::vector<double> found(rings * sectors);
    double others = 0.0;
    Sampler sampler(seed, stream);
    for (int i = 0; i < count; ++i) {
        sampler.start(static_cast<std::uint64_t>(i));
        const BsdfSample s = sample(bsdf, p, wo, sampler.next2());
        if (s.pdf == delta_pdf || s.pdf == 0.0) {
            others += 1.0;
            continue;
        }
        const double turn = std::atan2(s.wi.y, s.wi.x) / (2.0 * pi) + 0.5;
        const int ring = std::clamp(static_cast<int>((s.wi.z + 1.0) * 0.5 * rings), 0, rings - 1);
        found[static_cast<std::size_t>(ring * sectors + std::clamp(static_cast<int>(turn * sectors), 0, sectors - 1))] += 1.0;
    }
    CellCounts counts;
    for (int ring = 0; ring < rings; ++ring)
        for (int sector = 0; sector < sectors; ++sector) {
            const auto turn = [](int i) { return 2.0 * pi * i / sectors - pi; };
            const auto z = [](int i) { return 2.0 * i / rings - 1.0; };
            const double expected = count * over_cell(z(ring), z(ring + 1), turn(sector), turn(sector + 1),
                                                      [&](const Vec3& wi) { return pdf(bsdf, p, wo, wi); });
            counts.add(found[static_cast<std::size_t>(ring * sectors + sector)], expected);
        }
    if (others == 0.0) {
        EXPECT_NEAR(counts.all_expected / count, 1.0, 4e-3);  // the quadrature's error where a grazing lobe is narrow
    } else {
        counts.add(others, std::max(count - counts.all_expected, 0.0));
    }
    if (!counts.join_few()) {
        EXPECT_LE(counts.few_found, 40.0);
    }
    return counts.cells > 1 ? counts.p() : 1.0;
}

// weight · pdf = fs |cosθ|, and pdf() is the density that sample() says.
inline void expect_consistent_samples(const Bsdf& bsdf, const ShadingPoint& p, const Vec3& wo, double tolerance = 1e-9) {
    Sampler sampler(fixed_seed, 1);
    for (std::uint64_t i = 0; i < 1000; ++i) {
        sampler.start(i);
        const BsdfSample found = sample(bsdf, p, wo, sampler.next2());
        if (found.pdf == delta_pdf || found.pdf == 0.0) continue;
        EXPECT_NEAR(glm::length(found.wi), 1.0, 1e-12);
        EXPECT_NEAR(pdf(bsdf, p, wo, found.wi) / found.pdf, 1.0, tolerance);
        const Rgb exact = eval(bsdf, p, wo, found.wi) * std::abs(found.wi.z);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found.weight[c] * found.pdf, exact[c], tolerance * exact[c]);
    }
}

// The largest |fs(a → b)/fs(b → a) − 1|, relative to the larger one, over `count` pairs on the same side.
inline double largest_irreciprocity(const Bsdf& bsdf, const ShadingPoint& p, int count = 1000) {
    double worst = 0.0;
    Sampler sampler(fixed_seed, 2);
    for (int i = 0; i < count; ++i) {
        sampler.start(static_cast<std::uint64_t>(i));
        const Vec3 a = uniform_hemisphere(sampler.next2()), b = uniform_hemisphere(sampler.next2());
        const Rgb one = eval(bsdf, p, a, b), other = eval(bsdf, p, b, a);
        for (int c = 0; c < 3; ++c)
            if (one[c] != other[c]) worst = std::max(worst, std::abs(one[c] - other[c]) / std::max(one[c], other[c]));
    }
    return worst;
}

}  // namespace neumann::physics
