// The algebra of operators on functions: the same expressions, exact in furnaces; adjoints; and sums that keep their digits.
#include "core/geometry/area_sampler.h"
#include "core/sampling/sampler.h"
#include "core/sampling/warp.h"
#include "operators/algebra/neumann_series.h"
#include "operators/pointwise/emission.h"
#include "operators/pointwise/reflection.h"
#include "operators/pointwise/transport.h"
#include "tests/physics/scene_maker.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/parallel_for.h>

#include <array>
#include <cstdio>

namespace neumann::function_algebra_test {

using namespace physics;

struct Numbers : Random {
    Numbers(std::uint64_t seed, std::uint32_t stream) : sampler(seed, stream) { sampler.start(0); }
    double next() override { return sampler.next(); }
    Sampler sampler;
};

Scene furnace(double rho) {
    SceneMaker maker;
    maker.add(room({-1, -1, -1}, {1, 1, 1}), Surface{Rgb(rho), AreaLight(Rgb(1.0)), false});
    return maker.make();
}

// In a furnace T 1 = 1 and R 1 = ρ, and so are T* 1 and R* 1: every expression is a number.
TEST(FunctionAlgebra, ExpressionsAreNumbersInAFurnace) {
    constexpr double rho = 0.7, epsilon = std::numeric_limits<double>::epsilon();
    const Scene scene = furnace(rho);
    const TransportOperator T(scene.geometry);
    const ReflectionOperator R(scene.materials);
    const Identity<ExitantField> I;
    const auto K = R * T;
    const auto A = I - 0.5 * K + (K - 2.0 * I) * (0.25 * K * K);
    constexpr double a = 1.0 - 0.5 * rho + (rho - 2.0) * 0.25 * rho * rho;
    const ExitantField one = emission(scene.emitters);
    Numbers random(1, 0);
    SurfacePoint p;
    const Vec3 w = glm::normalize(Vec3(1.0, 2.0, -3.0));
    ASSERT_TRUE(scene.geometry.first_hit({0.1, 0.2, 0.3}, w, std::numeric_limits<double>::infinity(), p));
    EXPECT_NEAR(A(one)(p, -w, random).g, a, 16.0 * epsilon);
    EXPECT_NEAR(adjoint(A)(one)(p, -w, random).g, a, 16.0 * epsilon);
    NeumannSeries L(K, one);
    NeumannSeries W(adjoint(K), one);
    for (int i = 0; i <= 8; ++i, L.advance(), W.advance()) {
        const double term = std::pow(rho, i), sum = (1.0 - std::pow(rho, i + 1)) / (1.0 - rho);
        EXPECT_NEAR(L.term()(p, -w, random).g, term, 8.0 * (i + 1) * epsilon) << i;
        EXPECT_NEAR(W.term()(p, -w, random).g, term, 8.0 * (i + 1) * epsilon) << i;
        EXPECT_NEAR(L.sum()(p, -w, random).g, sum, 8.0 * (i + 1) * epsilon) << i;
        // (I − K) S_i = Le − K^(i+1) Le.
        EXPECT_NEAR((I - K)(L.sum())(p, -w, random).g, 1.0 - term * rho, 32.0 * (i + 1) * epsilon) << i;
    }
}

// Half a unit in the last place of 1, again and again, for what leaves upwards: the fields are functions of direction only.
TEST(FunctionAlgebra, TheSeriesIsCompensated) {
    struct Shift {
        using Domain = ExitantField;
        using Range = ExitantField;
        ExitantField operator()(ExitantField f) const {
            return ExitantField([f = std::move(f)](const SurfacePoint& p, const Vec3& w, Random& random) {
                return f(p, Vec3(0, 0, -1), random) * (w.z > 0.0 ? 0x1p-53 : 1.0);
            });
        }
    };
    NeumannSeries series(Shift(), ExitantField([](const SurfacePoint&, const Vec3&, Random&) { return Rgb(1.0); }));
    for (int i = 0; i < 64; ++i) series.advance();
    Numbers random(1, 0);
    EXPECT_EQ(series.sum()({}, Vec3(0, 0, 1), random), Rgb(1.0 + 0x1p-47));
    EXPECT_EQ(series.sum()({}, Vec3(0, 0, -1), random), Rgb(65.0));
}

// ⟨K² Le, g⟩ = ⟨Le, K*² g⟩, of surfaces of all kinds of reflectance; g is 1 where the ceiling faces down. 64 batches, three
// channels: |z| ≤ 4.5 is a false alarm in 50 000.
TEST(FunctionAlgebraSlow, AdjointsMeasureTheSame) {
    SceneMaker maker;
    const auto walls = room({-1, -1, -1}, {1, 1, 1});
    maker.add(walls[left], Surface{Rgb(0.2, 0.3, 0.4), AreaLight(Rgb(1.0, 2.0, 3.0)), false});
    maker.add(walls[right], Surface{Rgb(0.8, 0.1, 0.2), std::nullopt, false});
    maker.add(walls[front], Surface{Rgb(0.7, 0.8, 0.6), std::nullopt, false});
    maker.add(walls[back], made_of(RoughConductor<Ggx>(Ggx(0.4), {}, Rgb(0.8, 0.9, 0.7))));
    maker.add(walls[floor], Surface{Rgb(0.5, 0.4, 0.3), std::nullopt, false});
    maker.add(walls[ceiling], made_of(Conductor({}, Rgb(0.9))));
    const Scene scene = maker.make();
    const TransportOperator T(scene.geometry);
    const ReflectionOperator R(scene.materials);
    const auto K = R * T;
    const auto K_adjoint = adjoint(K);
    const ExitantField Le = emission(scene.emitters);
    const ExitantField g([](const SurfacePoint& p, const Vec3& w, Random&) { return Rgb(p.position.z > 0.999 && w.z < 0.0); });
    const ExitantField forth = K(K(Le)), back_again = K_adjoint(K_adjoint(g));
    const AreaSampler surfaces(scene.geometry);
    constexpr int batches = 64, samples = 1 << 18;
    // ∫∫ f h |cos θ| dω dA, its half to where the surfaces face.
    const auto inner_product = [&](const ExitantField& f, const ExitantField& h, std::uint32_t batch) {
        Numbers random(fixed_seed, batch);
        Rgb sum(0.0);
        for (int i = 0; i < samples; ++i) {
            const double choice = random.next();
            const SurfacePoint p = surfaces.sample(choice, random.next2());
            const Vec3 w = Frame(p.normal).to_world(cosine_hemisphere(random.next2()));
            const Rgb weight = h(p, w, random);
            if (!is_black(weight)) sum += f(p, w, random) * weight;
        }
        return sum * (pi * surfaces.area() / samples);
    };
    std::array<Rgb, batches> difference, value;
    oneapi::tbb::parallel_for(std::uint32_t{0}, std::uint32_t{batches}, [&](std::uint32_t b) {
        value[b] = inner_product(forth, g, b);
        difference[b] = value[b] - inner_product(back_again, Le, batches + b);
    });
    Rgb mean(0.0), seen(0.0), squares(0.0);
    for (int b = 0; b < batches; ++b) {
        mean += difference[b] / double{batches};
        seen += value[b] / double{batches};
    }
    for (const Rgb& d : difference) squares += (d - mean) * (d - mean);
    for (int c = 0; c < 3; ++c) {
        const double error = std::sqrt(squares[c] / (batches * (batches - 1.0)));
        std::printf("z %.2f, error %.2f%%\n", mean[c] / error, 100.0 * error / seen[c]);
        EXPECT_LE(std::abs(mean[c]), 4.5 * error) << c;
        EXPECT_LE(error, 0.003 * seen[c]) << "what this test can see";
    }
}

}  // namespace neumann::function_algebra_test
