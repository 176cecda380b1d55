// T traced again and again with other seeds, against exact solutions. Where the solution is constant on each surface, patches make
// no error of their own and what is left is the rays' noise: z-tests over 64 seeds as in tests/physics/probe.h, |z| ≤ 4.5, each a
// false alarm in 3e-5 of all new seeds; about 60 of them here. A matrix that is applied i times is the same each time, which biases
// K^i by about one part in rays · patches, below a tenth of the standard errors here.
#include "operators/algebra/neumann_series.h"
#include "operators/fields/matrix/light_vector.h"
#include "operators/fields/matrix/reflection_matrix.h"
#include "operators/fields/matrix/sides.h"
#include "operators/fields/matrix/transport_matrix.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

namespace neumann::known_answers_test {

using namespace physics;

// Means over a shape's front, bounce by bounce, of many seeds.
struct ShapeMeans {
    std::vector<std::vector<double>> of_seed;  // [seed][bounce]
    // `largest_error`: relative, of what is not random.
    void expect(const std::vector<double>& exact, const std::string& what, double largest_error = 1e-14) const {
        const auto n = static_cast<double>(of_seed.size());
        for (std::size_t i = 0; i < exact.size(); ++i) {
            double sum = 0.0, squares = 0.0;
            for (const auto& bounces : of_seed) sum += bounces[i];
            const double mean = sum / n;
            for (const auto& bounces : of_seed) squares += (bounces[i] - mean) * (bounces[i] - mean);
            const double error = std::sqrt(squares / (n * (n - 1.0)));
            EXPECT_LE(std::abs(mean - exact[i]), 4.5 * error + largest_error * std::abs(exact[i]))
                << what << ", bounce " << i << ": " << mean << " ± " << error << ", exactly " << exact[i];
            EXPECT_LE(error, 0.002 * std::abs(exact[i])) << what << ", bounce " << i << " has no power";
        }
    }
};

std::vector<ShapeMeans> run(const Scene& scene, std::size_t patches, std::uint32_t rays, int bounces) {
    constexpr std::uint64_t seeds = 64, fixed_seed = 20240229;
    const PatchSpace space(scene.geometry, {patches, 0.5}, side_directions(scene));
    const ReflectionMatrix<1> R(scene.materials, space);
    std::vector<ShapeMeans> result(scene.geometry.shapes().size());
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const RayTable table(space, rays, fixed_seed + seed);
        NeumannSeries series(R * TransportMatrix<1>(table), emitted_light<1>(scene, space));
        for (ShapeMeans& shape : result) shape.of_seed.emplace_back();
        for (int i = 0; i <= bounces; ++i, series.advance()) {
            std::vector<double> sum(result.size()), area(result.size());
            for (const Facet& facet : space.facets()) {
                if (!facet.front) continue;
                const std::uint32_t shape = space.patches().chart(facet.patch).shape();
                sum[shape] += series.term()(0, facet.first) * space.patches().area(facet.patch);
                area[shape] += space.patches().area(facet.patch);
            }
            for (std::size_t shape = 0; shape < result.size(); ++shape)
                result[shape].of_seed.back().push_back(sum[shape] / area[shape]);
        }
    }
    return result;
}

// A hemisphere closed by its disc, which emits 1: K = [[0, ρd], [ρh/2, ρh/2]].
TEST(KnownAnswers, Dome) {
    const double disc_albedo = 0.7, dome_albedo = 0.5;
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, matte(dome_albedo));
    maker.add(make_disk(Mat4(1.0)), glowing(disc_albedo, 1.0));
    const Scene scene = maker.make();
    constexpr std::size_t patches = 950;
    // The disc's plane is a line between patches: otherwise some would be half in the light.
    const Patches cut(scene.geometry, {patches, 0.5});
    for (const double y : {0.1, 0.5, 0.9})
        ASSERT_NE(cut.locate(scene.geometry.point(0, 0, {0.5 + 1e-9, y})), cut.locate(scene.geometry.point(0, 0, {0.5 - 1e-9, y})));
    const auto found = run(scene, patches, 64, 6);
    std::vector<double> disc{1.0}, dome{0.0};
    for (int i = 1; i <= 6; ++i) {
        disc.push_back(disc_albedo * dome[i - 1]);
        dome.push_back(dome_albedo * 0.5 * (disc[i - 1] + dome[i - 1]));
    }
    found[1].expect(disc, "disc");
}

// The outer of two concentric spheres, seen by the inner one with form factor 1; K has a negative eigenvalue.
TEST(KnownAnswers, NearParallelPlates) {
    const double c = 0.9, rho = 0.9;
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, c, false}, glowing(rho, 1.0));
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, matte(rho));
    const auto found = run(maker.make(), 1500, 64, 6);
    std::vector<double> inner{1.0}, outer{0.0};
    for (int i = 1; i <= 6; ++i) {
        inner.push_back(rho * outer[i - 1]);
        outer.push_back(rho * (c * c * inner[i - 1] + (1.0 - c * c) * outer[i - 1]));
    }
    found[0].expect(inner, "inner");
    found[1].expect(outer, "outer");
}

// The inside of a sphere: K^i Le (p) = ρ(p) <ρ>^(i−1) <Le>.
TEST(KnownAnswers, Sphere) {
    const auto z = [](const SurfacePoint& p) { return p.position.z; };
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true},
              Surface{SurfaceFunction([z](const SurfacePoint& p) { return grey(0.5 + 0.4 * z(p)); }, grey(0.9)),
                      AreaLight([z](const SurfacePoint& p, const Vec3&) { return grey(1.0 + z(p) * z(p)); }, grey(2.0)), false});
    const auto found = run(maker.make(), 1000, 64, 6);
    std::vector<double> exact{4.0 / 3.0};
    for (int i = 1; i <= 6; ++i) exact.push_back(std::pow(0.5, i) * 4.0 / 3.0);
    found[0].expect(exact, "sphere", 1e-5);  // the mean of Le over a patch is taken from 16 points
}

// The largest albedo is 1.6, and yet the terms fall by 0.9.
TEST(KnownAnswers, SphereWithAlbedoAboveOne) {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true},
              Surface{SurfaceFunction([](const SurfacePoint& p) { return grey(p.position.z > 0.0 ? 1.6 : 0.2); }, grey(1.6)),
                      AreaLight(grey(1.0)), false});
    const auto found = run(maker.make(), 2000, 64, 6);
    std::vector<double> exact;
    for (int i = 0; i <= 6; ++i) exact.push_back(std::pow(0.9, i));
    found[0].expect(exact, "sphere");
}

// The means of K^i Le, i ≥ 1, over points, read between patches.
std::vector<double> means_at(const Scene& scene, const std::vector<std::pair<SurfacePoint, Vec3>>& places, std::size_t patches,
                             std::uint32_t rays, int bounces) {
    const PatchSpace space(scene.geometry, {patches, 0.5}, side_directions(scene));
    const RayTable table(space, rays, 1);
    const ReflectionMatrix<1> R(scene.materials, space);
    NeumannSeries series(R * TransportMatrix<1>(table), emitted_light<1>(scene, space));
    std::vector<double> means;
    for (int i = 1; i <= bounces; ++i) {
        series.advance();
        double sum = 0.0;
        for (const auto& [p, w] : places) {
            const PatchSpace::Reading reading = space.read(p, w);
            for (std::size_t k = 0; k < 4; ++k) sum += reading.weight[k] * series.term()(0, reading.unknown[k]);
        }
        means.push_back(sum / static_cast<double>(places.size()));
    }
    return means;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& exact, double part, const std::string& what) {
    for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_NEAR(found[i], exact[i], part * exact[i]) << what << ", bounce " << i + 1;
}

// A tube as long as wide, under a sky of 1: black discs that emit 1 close its ends. Halfway, and a tenth from an end; g_i by
// collocation, refined until it stands still.
TEST(KnownAnswersSlow, TubeUnderTheSky) {
    const double rho = 0.9;
    SceneMaker maker;
    maker.add(Cylinder{{0, 0, 0}, {0, 0, 1}, 1.0, 0.5, true}, matte(rho));
    maker.add(Disk{{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 1}}, lamp(1.0));
    maker.add(Disk{{0, 0, 1}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, -1}}, lamp(1.0));
    const Scene scene = maker.make();
    const std::pair<double, std::array<double, 6>> known[] = {
        {0.5, {.3416407865, .2613828810, .1606829682, .0958882078, .0569955175, .0338604273}},
        {0.1, {.4811842986, .2167181211, .1230976372, .0727009451, .0431553664, .0256337362}}};
    for (const auto& [z, g] : known) {
        std::vector<std::pair<SurfacePoint, Vec3>> places;
        for (int k = 0; k < 64; ++k) {
            const SurfacePoint p = scene.geometry.point(0, 0, {z, (k + 0.5) / 64.0});
            ASSERT_NEAR(p.position.z, z, 1e-12);
            places.emplace_back(p, p.normal);
        }
        std::vector<double> exact;
        for (std::size_t i = 0; i < g.size(); ++i) exact.push_back(g[i] * std::pow(rho, i + 1.0));
        expect_near(means_at(scene, places, 8000, 1024, 6), exact, 0.003, "tube at " + std::to_string(z));
    }
}

// A groove of 90° with sides of length 1, under a sky of 1, which a black lid emits, and black triangles at its ends, 10 away. The
// ends are seen under less than 3e-3 of the cosine-weighted hemisphere, and what would be seen there is some tenths darker; the
// noise of 512 rays from each of a hundred patches is about 0.3%.
TEST(KnownAnswersSlow, GrooveUnderTheSky) {
    const double rho = 0.9, half = 10.0;
    const std::pair<double, std::array<double, 3>> known[] = {{0.25, {.6212678125, .2510345549, .0843030109}},
                                                              {0.5, {.7236067977, .1962163307, .0548462712}},
                                                              {0.75, {.8, .1463780853, .0372189191}}};
    SceneMaker maker;
    maker.add(parallelogram({0, -half, 0}, {1, 0, 0}, {0, 2.0 * half, 0}), matte(rho));
    maker.add(parallelogram({0, -half, 0}, {0, 2.0 * half, 0}, {0, 0, 1}), matte(rho));
    maker.add(parallelogram({1, -half, 0}, {-1, 0, 1}, {0, 2.0 * half, 0}), lamp(1.0));
    maker.add(triangle({0, -half, 0}, {0, -half, 1}, {1, -half, 0}), lamp(1.0));
    maker.add(triangle({0, half, 0}, {1, half, 0}, {0, half, 1}), lamp(1.0));
    const Scene scene = maker.make();
    for (const auto& [x, g] : known) {
        std::vector<std::pair<SurfacePoint, Vec3>> places;
        for (int k = 0; k < 64; ++k) {
            SurfacePoint p;
            ASSERT_TRUE(scene.geometry.first_hit({x, 6.0 * (k + 0.5) / 64.0 - 3.0, 0.1}, {0, 0, -1}, 1.0, p));
            places.emplace_back(p, p.normal);
        }
        std::vector<double> exact;
        for (std::size_t i = 0; i < g.size(); ++i) exact.push_back(g[i] * std::pow(rho, i + 1.0));
        expect_near(means_at(scene, places, 16000, 512, 3), exact, 0.01, "groove at " + std::to_string(x));
    }
}

}  // namespace neumann::known_answers_test
