// The photon map finds what a loop over all photons finds, its kernel has the integral 1, and radii shrink as they should.
#include "operators/paths/photons/photon_map.h"
#include "operators/paths/photons/photon_settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace neumann::photon_map_test {

// On the faces of a cube of edge 2, some of which face in.
std::vector<Photon> scattered(std::size_t count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> place(-1.0f, 1.0f);
    std::vector<Photon> photons;
    for (std::uint32_t i = 0; i < count; ++i) {
        Photon p{};
        const int axis = static_cast<int>(random() % 3);
        p.position = {place(random), place(random), place(random)};
        p.position[axis] = random() % 2 ? 1.0f : -1.0f;
        p.normal[axis] = random() % 2 ? 1.0f : -1.0f;
        p.path = i;
        photons.push_back(p);
    }
    return photons;
}

SurfacePoint point(const Photon& at) {
    SurfacePoint x;
    x.position = Vec3(at.position);
    x.normal = Vec3(at.normal);
    return x;
}

TEST(PhotonMap, FindsWhatLiesNearby) {
    const std::vector<Photon> all = scattered(5000);
    PhotonMap built(all);
    const PhotonMap map = std::move(built);  // it may be moved
    std::vector<PhotonMap::NearPhoton> near;
    std::size_t found = 0;
    for (const double radius : {0.01, 0.1, 0.5, 3.0}) {
        for (std::size_t k = 0; k < 200; ++k) {
            const SurfacePoint x = point(all[k]);
            map.find(x, radius, near);
            std::vector<std::uint32_t> expected, paths;
            for (const Photon& p : all) {
                const Vec3 d = Vec3(p.position) - x.position;
                if (glm::length(d) < radius && std::abs(glm::dot(Vec3(p.normal), x.normal)) >= 0.5 &&
                    std::abs(glm::dot(d, x.normal)) <= 0.2 * radius)
                    expected.push_back(p.path);
            }
            for (const PhotonMap::NearPhoton& n : near) {
                paths.push_back(n.photon->path);
                const Vec3 d = Vec3(n.photon->position) - x.position;
                EXPECT_NEAR(n.distance2, glm::dot(d, d), 1e-6);
            }
            std::ranges::sort(paths);
            EXPECT_EQ(paths, expected) << radius;
            found += paths.size();
        }
    }
    EXPECT_GT(found, 10000u);
}

TEST(PhotonMap, KnowsTheDistanceOfTheKth) {
    const std::vector<Photon> all = scattered(1000);
    const PhotonMap map(all);
    for (const std::size_t k : {1u, 2u, 20u, 1000u}) {
        const Vec3 x(0.3, -0.2, 0.9);
        std::vector<double> distances;
        for (const Photon& p : all) distances.push_back(glm::length(Vec3(p.position) - x));
        std::ranges::sort(distances);
        EXPECT_NEAR(map.distance(x, k), distances[k - 1], 1e-6) << k;
    }
    EXPECT_EQ(map.distance(Vec3(0.0), 1001), std::numeric_limits<double>::infinity());
}

TEST(PhotonMap, MayBeEmpty) {
    const PhotonMap map({});
    std::vector<PhotonMap::NearPhoton> near(3);
    SurfacePoint x;
    x.position = x.normal = Vec3(1.0, 0.0, 0.0);
    map.find(x, 1.0, near);
    EXPECT_TRUE(near.empty());
    EXPECT_EQ(map.distance(Vec3(0.0), 1), std::numeric_limits<double>::infinity());
}

// ∫ k(d) 2π d dd, by the midpoint rule, whose error is of order 1/n².
TEST(PhotonMap, KernelHasTheIntegralOne) {
    for (const double radius : {0.1, 7.0}) {
        constexpr int n = 10000;
        double sum = 0.0;
        for (int i = 0; i < n; ++i) {
            const double d = radius * (i + 0.5) / n;
            sum += kernel(d * d, radius * radius) * 2.0 * pi * d * radius / n;
        }
        EXPECT_NEAR(sum, 1.0, 1e-7);
    }
}

// Knaus and Zwicker's recursion, and what it is there for: the mean of 1/r² over n passes, by which variance grows, is of order
// n^(1 − α), and that of r², by which bias falls, of order n^(α − 1).
TEST(PhotonMap, RadiiShrink) {
    EXPECT_DOUBLE_EQ(relative_radius(0), 1.0);
    double product = 1.0, inverse = 0.0, squares = 0.0;
    std::vector<std::pair<double, double>> means;
    constexpr int last = 1 << 16;
    for (int i = 1; i <= last; ++i) {
        const double r2 = std::pow(relative_radius(static_cast<std::uint64_t>(i) - 1), 2.0);
        EXPECT_NEAR(r2, product, 1e-9);
        product *= (i + kept_variance) / (i + 1.0);
        inverse += 1.0 / r2;
        squares += r2;
        if (i == last / 4 || i == last) means.emplace_back(inverse / i, squares / i);
    }
    EXPECT_NEAR(std::log(means[1].first / means[0].first) / std::log(4.0), 1.0 - kept_variance, 0.001);
    EXPECT_NEAR(std::log(means[1].second / means[0].second) / std::log(4.0), kept_variance - 1.0, 0.001);
}

}  // namespace neumann::photon_map_test
