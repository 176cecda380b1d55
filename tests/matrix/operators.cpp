// What holds by construction, to rounding: rows of T, the furnace, norms, adjoints, and L = Le + K L.
#include "core/sampling/sampler.h"
#include "operators/algebra/neumann_series.h"
#include "operators/experiments/known/enclosures.h"
#include "operators/fields/matrix/inner_product.h"
#include "operators/fields/matrix/light_vector.h"
#include "operators/fields/matrix/sides.h"
#include "operators/fields/matrix/transport_matrix.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <algorithm>

namespace neumann::operators_test {

using namespace known;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

template <int C>
struct System {
    System(const Scene& scene, std::size_t patches, std::uint32_t rays, std::uint64_t seed = 0)
        : space(scene.geometry, {patches, 0.6}, side_directions(scene)),
          table(space, rays, seed),
          T(table),
          R(scene.materials, space),
          Le(emitted_light<C>(scene, space)) {}

    PatchSpace space;
    RayTable table;
    TransportMatrix<C> T;
    ReflectionMatrix<C> R;
    ExitantVector<C> Le;
};

template <int C>
ExitantVector<C> random_field(const PatchSpace& space, std::uint32_t stream) {
    Sampler random(11, stream);
    random.start(0);
    ExitantVector<C> f = ExitantVector<C>::zero(space.size());
    for (std::uint32_t u = 0; u < space.size(); ++u)
        for (int c = 0; c < (C == 4 ? 3 : C); ++c) f(c, u) = random.next() - 0.5;
    return f;
}

Surface coloured(const Rgb& rho) { return {rho, std::nullopt, true}; }

Scene colourful_room() {
    SceneMaker maker;
    const auto walls = room({-1, -1, -1}, {1, 1, 1});
    const Rgb colours[6] = {{0.8, 0.1, 0.2}, {0.1, 0.7, 0.3}, {0.9, 0.9, 0.9}, {0.5, 0.4, 0.3}, {0.7, 0.8, 0.95}, {0.6, 0.6, 0.6}};
    for (std::size_t i = 0; i < 6; ++i) maker.add(walls[i], coloured(colours[i]));
    maker.add(box({0.1, 0.2, -0.9}, {0.5, 0.6, 0.1}), coloured({0.3, 0.6, 0.9}));
    maker.add(Sphere{{-0.4, -0.3, 0.2}, 0.3, false}, Surface{Rgb(0.2, 0.5, 0.4), AreaLight(Rgb(1.0, 2.0, 3.0)), false});
    return maker.make();
}

TEST(TransportMatrix, RowsSumToOneInClosedScenes) {
    for (const ClosedScene& e : enclosures(matte(0.5))) {
        const Scene scene = e.maker.make();
        for (const std::uint64_t seed : {0u, 1u, 2u}) {
            const System<1> s(scene, 500, 64, seed);
            std::size_t nothing = 0;
            for (const std::uint32_t u : s.table.seen()) nothing += u == s.space.nothing();
            EXPECT_EQ(nothing, 0u) << e.name;
        }
    }
}

// Rays that ask nothing about what is near differ where surfaces touch, within a millionth of the scene.
TEST(TransportMatrix, RoughRaysSeeTheSameElsewhere) {
    std::vector<ClosedScene> scenes = enclosures(matte(0.5));
    SceneMaker maker;
    maker.add(room({-2, -2, -2}, {2, 2, 2}), matte(0.5));
    maker.add(icosphere(5), matte(0.5));
    scenes.push_back({"fine mesh in a room", std::move(maker)});
    for (const ClosedScene& e : scenes) {
        const Scene scene = e.maker.make();
        const PatchSpace space(scene.geometry, {500, 0.6}, side_directions(scene));
        const RayTable exact(space, 64, 5), rough(RowShare(space), 64, 5, {}, {}, nullptr, true);
        std::size_t others = 0;
        for (std::size_t i = 0; i < exact.seen().size(); ++i) others += exact.seen()[i] != rough.seen()[i];
        EXPECT_LE(static_cast<double>(others), 1e-3 * static_cast<double>(exact.seen().size())) << e.name;
    }
}

TEST(TransportMatrix, RowsSumToLessWhereLightEscapes) {
    SceneMaker maker;
    maker.add(parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), matte(0.5));
    maker.add(parallelogram({0, 0, 1}, {0, 1, 0}, {1, 0, 0}), matte(0.5));
    const Scene scene = maker.make();
    const System<1> s(scene, 200, 64);
    std::size_t found = 0;
    for (const std::uint32_t u : s.table.seen()) found += u != s.space.nothing();
    // The form factor of parallel unit squares at distance 1, from 200 patches of 64 rays: its one-sample variance is F(1−F).
    const double F = 0.19982489569838738304, n = static_cast<double>(s.table.seen().size());
    EXPECT_LE(std::abs(static_cast<double>(found) / n - F), 4.5 * std::sqrt(F * (1.0 - F) / n));
}

// |K^i Le − ρ^i| ≤ 8 i ε in every patch, for each channel, whatever the mesh.
TEST(ReflectionMatrix, FurnaceIsExact) {
    for (const ClosedScene& e : enclosures(Surface{Rgb(0.25, 0.7, 0.999), AreaLight(Rgb(1.0)), false})) {
        const Scene scene = e.maker.make();
        const System<4> s(scene, 400, 32);
        NeumannSeries series(s.R * s.T, s.Le);
        for (int i = 0; i <= 20; ++i, series.advance())
            for (std::uint32_t u = 0; u < s.space.size(); ++u)
                for (int c = 0; c < 3; ++c) {
                    const double exact = std::pow(Rgb(0.25, 0.7, 0.999)[c], i);
                    ASSERT_NEAR(series.term()(c, u), exact, 8.0 * std::max(i, 1) * epsilon) << e.name << " bounce " << i;
                }
    }
}

TEST(ReflectionMatrix, NormIsAtMostTheLargestAlbedo) {
    const Scene scene = colourful_room();
    const System<4> s(scene, 800, 32);
    ExitantVector<4> one = ExitantVector<4>::zero(s.space.size());
    for (std::uint32_t u = 0; u < s.space.size(); ++u) one.col(u).setOnes();
    const ExitantVector<4> K_one = (s.R * s.T)(one);
    const Rgb albedo = scene.materials.largest_albedo();
    for (int c = 0; c < 3; ++c) EXPECT_LE(K_one.row(c).maxCoeff(), albedo[c] * (1.0 + 4.0 * epsilon));
}

// Of Le, and of b = K Le where that is sampled on the lights: then L = Le + Σ K^i b.
TEST(MatrixSeries, SumsSolveTheEquationUpToTheNextTerm) {
    const Scene scene = colourful_room();
    const System<4> s(scene, 800, 32);
    const auto K = s.R * s.T;
    for (const ExitantVector<4>& source : {s.Le, s.R(arriving_light<4>(scene, s.R, 64, 1))}) {
        NeumannSeries series(K, source);
        for (int i = 0; i < 12; ++i) {
            const ExitantVector<4> residual = source + K(series.sum()) - series.sum();
            const double size = series.sum().values().abs().maxCoeff();
            series.advance();
            EXPECT_LE((residual - series.term()).values().abs().maxCoeff(), 32.0 * epsilon * size) << i;
        }
    }
}

TEST(Adjoint, DotTestsHoldForTAndRAndK) {
    const Scene scene = colourful_room();
    const System<4> s(scene, 600, 32);
    const auto R_adjoint = adjoint(s.R);
    const auto T_adjoint = adjoint(s.T);
    const auto f = random_field<4>(s.space, 0), g = random_field<4>(s.space, 1);
    const double size = s.space.patches().size();

    const IncidentVector<4> R_star_g = R_adjoint(g);
    const Channels<4> Tf_a = inner_product(s.space, s.T(f), R_star_g), f_Ta = inner_product(s.space, f, T_adjoint(R_star_g));
    const Channels<4> RTf_g = inner_product(s.space, s.R(s.T(f)), g);
    const Channels<4> Kf_g = inner_product(s.space, (s.R * s.T)(f), g), f_Kg = inner_product(s.space, f, adjoint(s.R * s.T)(g));
    for (int c = 0; c < 3; ++c) {
        const double scale = epsilon * size * 4.0;
        EXPECT_NEAR(Tf_a[c], f_Ta[c], scale) << "T";
        EXPECT_NEAR(RTf_g[c], Tf_a[c], scale) << "R";
        EXPECT_NEAR(Kf_g[c], f_Kg[c], scale) << "K";
        EXPECT_GT(std::abs(Kf_g[c]), 1e3 * scale);
    }
}

TEST(Adjoint, ImportanceMeasuresEveryBounce) {
    const Scene scene = colourful_room();
    const System<4> s(scene, 600, 32);
    const auto K = s.R * s.T;
    const auto K_adjoint = adjoint(K);
    ExitantVector<4> We = ExitantVector<4>::zero(s.space.size());
    for (std::uint32_t u = 0; u < 40; ++u) We.col(u).head(3).setConstant(1.0 + u);
    for (const ExitantVector<4>& source : {s.Le, s.R(arriving_light<4>(scene, s.R, 64, 1))}) {
        NeumannSeries light(K, source);
        NeumannSeries importance(K_adjoint, We);
        for (int i = 0; i <= 8; ++i, light.advance(), importance.advance()) {
            const Channels<4> seen = inner_product(s.space, We, light.term()),
                              worth = inner_product(s.space, importance.term(), source);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], worth[c], 1e-12 * std::abs(seen[c])) << i;
            EXPECT_TRUE(i == 0 || seen[0] > 0.0) << i;
        }
    }
}

TEST(RayTable, IsTheSameOnAnyNumberOfThreads) {
    const Scene scene = colourful_room();
    const System<4> all(scene, 800, 64, 5);
    const auto K_all = (all.R * all.T)(random_field<4>(all.space, 2));
    for (const std::size_t threads : {1u, 7u}) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        const System<4> some(scene, 800, 64, 5);
        EXPECT_TRUE(std::equal(all.table.seen().begin(), all.table.seen().end(), some.table.seen().begin()));
        EXPECT_TRUE(((some.R * some.T)(random_field<4>(some.space, 2)).values() == K_all.values()).all());
    }
    const System<4> other(scene, 800, 64, 6);
    EXPECT_FALSE(std::equal(all.table.seen().begin(), all.table.seen().end(), other.table.seen().begin()));
}

TEST(MatrixSeries, EmissionTimesAPowerOfTwoScalesBitwise) {
    const Scene scene = colourful_room();
    const System<4> s(scene, 300, 32);
    const auto K = s.R * s.T;
    NeumannSeries series(K, s.Le), scaled(K, 0x1p-40 * s.Le);
    for (int i = 0; i < 8; ++i, series.advance(), scaled.advance())
        EXPECT_TRUE((scaled.term().values() == series.term().values() * 0x1p-40).all());
}

}  // namespace neumann::operators_test
