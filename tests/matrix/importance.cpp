// Importance K*^i We from the camera's rays: what it says that light counts for the pictures is what the pictures show.
#include "operators/fields/matrix/camera_vector.h"
#include "operators/fields/matrix/inner_product.h"
#include "operators/fields/matrix/light_vector.h"
#include "operators/fields/matrix/scene_reflection.h"
#include "operators/fields/matrix/series_rest.h"
#include "operators/fields/matrix/sides.h"
#include "operators/fields/matrix/traced_series.h"
#include "operators/render/from_fields/field_rendering.h"
#include "tests/physics/scene_maker.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>

namespace neumann::importance_test {

using namespace physics;
constexpr int N = 4;

// A camera in the middle, which sees a part of the wall that shines; T's rays meet that often enough for K Le to be T's own.
Scene lit_room(const Surface& back_wall) {
    SceneMaker maker;
    const auto walls = room({-1, -1, -1}, {1, 1, 1});
    maker.add(walls[left], Surface{Rgb(0.2, 0.3, 0.4), AreaLight(Rgb(1.0, 2.0, 3.0)), false});
    maker.add(walls[right], Surface{Rgb(0.8, 0.1, 0.2), std::nullopt, false});
    for (const std::size_t face : {front, floor, ceiling}) maker.add(walls[face], Surface{Rgb(0.7, 0.8, 0.6), std::nullopt, false});
    maker.add(walls[back], back_wall);
    maker.parts.camera.fov = 1.9;
    maker.parts.film = {16, 16, 0, 0, 16, 16};
    return maker.make();
}

// ⟨f_i, g_j⟩ of one channel.
double inner_product(const FieldStack& f, int i, const FieldStack& g, int j, int c) {
    double sum = 0.0;
    for (const Facet& facet : f.space().facets())
        for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u)
            sum += double{f[u][3 * i + c]} * double{g[u][3 * j + c]} * f.space().measure(facet);
    return sum;
}

// To the rounding of the stacks' floats: all terms are positive.
constexpr double rounding = 4.0 * std::numeric_limits<float>::epsilon();

TEST(Importance, MeasuresEveryBounceOnBothSpaces) {
    const Scene scene = lit_room(matte(0.5));
    const PatchSpace space(scene.geometry, {300, 0.6}, side_directions(scene)), coarser = space.coarser();
    const TracedSeriesSettings settings{.bounces = N, .rays = 64, .seed = 3, .camera_samples = 4};
    const TracedSeries light = trace_series(scene, space, coarser, settings),
                       importance = trace_importance(scene, space, coarser, SceneReflection(scene, space), settings);
    ASSERT_EQ(light.light_rays, 0u);
    for (const auto field : {&TracedSeries::fine, &TracedSeries::coarse})
        for (int i = 0; i <= N + 1; ++i)
            for (int c = 0; c < 3; ++c) {
                const FieldStack &L = light.*field, &W = importance.*field;
                const double seen = inner_product(W, 0, L, i, c), worth = inner_product(W, i, L, 0, c);
                // The rest is closed as a geometric series.
                EXPECT_NEAR(worth, seen, (i <= N ? rounding : 2.0 * closing_error) * seen) << i << " " << c;
                EXPECT_GT(seen, 0.0);
            }
}

// Where light depends on direction, We is not averaged before it meets it.
TEST(Importance, IsTheMeanOverDirections) {
    const Scene scene = lit_room(made_of(RoughConductor<Ggx>(Ggx(0.4), {}, Rgb(0.8, 0.9, 0.7))));
    const PatchSpace space(scene.geometry, {60, 0.6}, side_directions(scene)), coarser = space.coarser();
    ASSERT_GT(space.size(), space.facets().size());
    const TracedSeriesSettings settings{.bounces = N, .rays = 64, .seed = 3, .rest = false, .camera_samples = 16};
    const TracedSeries light = trace_series(scene, space, coarser, settings),
                       importance = trace_importance(scene, space, coarser, SceneReflection(scene, space), settings);
    ASSERT_EQ(light.light_rays, 0u);
    FieldStack We(space, 0);
    We.set<4>(0, camera_importance<4>(scene, space, settings.camera_samples, settings.seed));
    for (int i = 0; i <= N; ++i)
        for (int c = 0; c < 3; ++c) {
            const double seen = inner_product(We, 0, light.fine, i, c);
            EXPECT_NEAR(inner_product(importance.fine, i, light.fine, 0, c), seen, rounding * seen) << i << " " << c;
        }
    for (const Facet& facet : space.facets())
        for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u)
            EXPECT_EQ(importance.fine[u][3 * N], importance.fine[facet.first][3 * N]);
}

// ⟨K*^i We, Le⟩ is the mean of the picture of bounce i; each replicate has the same rays of T and other camera rays. N + 1
// comparisons at |z| ≤ 4.5: false alarm 7·10⁻⁶ each.
TEST(Importance, MeasuresTheMeansOfThePictures) {
    const Scene scene = lit_room(matte(0.5));
    const FieldSettings settings{.reading = FieldReading::patches,
                                 .bounces = N,
                                 .patching = {200, 0.6},
                                 .rays = 64,
                                 .samples = 16,
                                 .replicates = 64,
                                 .seed = fixed_seed,
                                 .rest = false};
    const FieldPictures pictures = *render_fields(scene, settings);
    const PatchSpace space(scene.geometry, settings.patching, side_directions(scene)), coarser = space.coarser();
    FieldStack Le(space, 0);
    Le.set<4>(0, emitted_light<4>(scene, space));
    std::array<double, N + 1> sum{}, squares{}, mean{};
    for (std::uint32_t r = 0; r < settings.replicates; ++r) {
        const TracedSeriesSettings traced{.bounces = N,
                                          .rays = settings.rays,
                                          .light_samples = settings.light_samples,
                                          .seed = settings.seed * 0x10001 + r,
                                          .rest = false,
                                          .camera_samples = settings.samples};
        const FieldStack importance = trace_importance(scene, space, coarser, SceneReflection(scene, space), traced).fine;
        for (int i = 0; i <= N; ++i) {
            double worth = 0.0;
            for (int c = 0; c < 3; ++c) worth += inner_product(importance, i, Le, 0, c) / 3.0;
            const double seen = pictures.replicate_mean(r, static_cast<std::size_t>(i)), difference = worth - seen;
            mean[i] += seen / settings.replicates;
            sum[i] += difference;
            squares[i] += difference * difference;
        }
    }
    const double n = settings.replicates;
    for (int i = 0; i <= N; ++i) {
        const double standard_error = std::sqrt((squares[i] - sum[i] * sum[i] / n) / (n * (n - 1.0)));
        EXPECT_LE(std::abs(sum[i] / n), 4.5 * standard_error) << i;
        EXPECT_LE(standard_error, 0.002 * mean[i]) << "what this test can see";
    }
}

// The lamp is not seen where the camera's rays go through it.
TEST(Importance, HiddenLightsHaveNoneOfTheCameraItself) {
    for (const bool hidden : {false, true}) {
        Scene scene = lit_room(matte(0.5));
        scene.hide_emitters = hidden;
        const PatchSpace space(scene.geometry, {100, 0.6}, side_directions(scene));
        const auto We = camera_importance<4>(scene, space, 4, 0), Le = emitted_light<4>(scene, space);
        EXPECT_EQ(inner_product(space, We, Le)[0] == 0.0, hidden);
        EXPECT_GT(We.values().maxCoeff(), 0.0);
    }
}

}  // namespace neumann::importance_test
