// How the error of a traced matrix falls: with the patches as that of exact form factors does, with the rays at least as fast as
// that of independent ones.
#include "operators/algebra/neumann_series.h"
#include "operators/fields/matrix/light_vector.h"
#include "operators/fields/matrix/reflection_matrix.h"
#include "operators/fields/matrix/sides.h"
#include "operators/fields/matrix/transport_matrix.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::refinement_test {

using namespace physics;

// The unit cube of albedo 1 whose ceiling emits 1, n × n equal patches a face: the means of bounce 2 on a wall, the floor and the
// ceiling.
std::array<double, 3> second_bounce(std::size_t n, std::uint32_t rays, std::uint64_t seed) {
    SceneMaker maker;
    const auto faces = room({0, 0, 0}, {1, 1, 1});
    for (std::size_t face = 0; face < 6; ++face) maker.add(faces[face], face == ceiling ? glowing(1.0, 1.0) : matte(1.0));
    const Scene scene = maker.make();
    const PatchSpace space(scene.geometry, {6 * n * n, 0.0}, side_directions(scene));
    EXPECT_EQ(space.size(), 6 * n * n);
    const RayTable table(space, rays, seed);
    const ReflectionMatrix<1> R(scene.materials, space);
    NeumannSeries series(R * TransportMatrix<1>(table), emitted_light<1>(scene, space));
    series.advance();
    series.advance();
    std::array<double, 3> means{};
    for (const Facet& facet : space.facets()) {
        const std::uint32_t shape = space.patches().chart(facet.patch).shape();
        const double part = series.term()(0, facet.first) * space.patches().area(facet.patch);
        if (shape == floor)
            means[1] += part;
        else if (shape == ceiling)
            means[2] += part;
        else
            means[0] += part / 4.0;
    }
    return means;
}

// The means are known to 1e-13 by quadrature of closed forms, and with them the largest error of n × n patches with exact form
// factors: 6.83e-3, 2.02e-3, 5.80e-4 for n = 4, 8, 16. Eight seeds' mean; the noise is that of 2^20 to 2^22 rays, below 3e-5.
TEST(RefinementSlow, OfPatches) {
    const std::array<double, 3> exact{0.15671177281027, 0.11740200680622, 0.25575090195272};
    struct Row {
        std::size_t n;
        std::uint32_t rays;
        double error;
    };
    for (const auto& [n, rays, error] : {Row{4, 16384, 6.83e-3}, {8, 8192, 2.02e-3}, {16, 4096, 5.80e-4}}) {
        std::array<double, 3> mean{};
        for (std::uint64_t seed = 0; seed < 8; ++seed) {
            const auto found = second_bounce(n, rays, seed);
            for (std::size_t k = 0; k < 3; ++k) mean[k] += found[k] / 8.0;
        }
        double largest = 0.0;
        for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs(mean[k] - exact[k]));
        EXPECT_NEAR(largest, error, 3e-5 + 0.005 * error) << n << " × " << n;
    }
}

// Over 32 seeds: sixteen times as many rays, at most a quarter of the spread.
TEST(RefinementSlow, OfRays) {
    double last = 0.0;
    for (const std::uint32_t rays : {16u, 256u, 4096u}) {
        double sum = 0.0, squares = 0.0;
        constexpr int seeds = 32;
        for (std::uint64_t seed = 0; seed < seeds; ++seed) {
            const double x = second_bounce(4, rays, seed)[1];
            sum += x;
            squares += x * x;
        }
        const double spread = std::sqrt((squares - sum * sum / seeds) / (seeds - 1));
        EXPECT_TRUE(last == 0.0 || spread < 0.25 * last) << rays << " rays: " << spread << " after " << last;
        last = spread;
    }
}

}  // namespace neumann::refinement_test
