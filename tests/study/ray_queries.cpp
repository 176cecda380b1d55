// What an estimator from outside is told: against Geometry, and in the unit cube, whose walls all shine 1.
#include "operators/experiments/queries/ray_queries.h"
#include "core/reader/read_scene.h"
#include "operators/experiments/queries/camera_rays.h"

#include <gtest/gtest.h>

namespace neumann::ray_queries_test {

Scene furnace() { return read_scene(SCENES "/furnace/furnace.xml", {{"albedo", "0.25"}, {"res", "5"}}); }
Scene cornell() { return read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "20"}}); }

std::vector<Ray> rays_of(const Scene& scene, std::uint64_t samples) {
    const CameraRays made = camera_rays(scene, 0, samples, 1);
    return {made.rays.begin(), made.rays.end()};
}

TEST(RayQueries, SeeTheWallsOfACube) {
    const std::vector<Ray> rays{
        {Vec3(0, 0.1, 0.3), Vec3(1, 0, 0)}, {Vec3(0.5, 0.2, 0), Vec3(0, 0, -1)}, {Vec3(0.0), Vec3(0, 1, 0), 0.5}};
    const auto seen = see(furnace(), rays);
    EXPECT_EQ(seen[0].distance, 1.0);
    EXPECT_EQ(seen[0].y.position, Vec3(1, 0.1, 0.3));
    EXPECT_EQ(seen[0].normal, Vec3(-1, 0, 0));
    EXPECT_EQ(seen[0].emission, Rgb(1.0));
    EXPECT_EQ(seen[0].reflectance, Rgb(0.25));
    EXPECT_EQ(seen[1].y.position, Vec3(0.5, 0.2, -1));
    // A ray that is too short.
    EXPECT_TRUE(seen[2].y.is_infinite());
    EXPECT_TRUE(std::isinf(seen[2].distance) && std::isnan(seen[2].normal.x) && std::isnan(seen[2].reflectance.x));
    EXPECT_EQ(seen[2].emission, Rgb(0.0));
}

TEST(RayQueries, AreGeometrysFromSurfaces) {
    const Scene scene = cornell();
    const auto first = see(scene, rays_of(scene, 3));
    std::vector<SurfacePoint> from;
    std::vector<Vec3> directions;
    for (const SeenPoint& seen : first) {
        if (seen.y.is_infinite()) continue;
        from.push_back(seen.y);
        directions.push_back(
            glm::normalize(seen.normal + 0.9 * glm::normalize(Vec3(0.3, 0.1 * static_cast<double>(from.size() % 13), -0.2))));
    }
    ASSERT_GT(from.size(), 1000u);
    const auto second = see(scene, from, directions);
    std::vector<SurfacePoint> to;
    for (std::size_t i = 0; i < from.size(); ++i) {
        SurfacePoint hit;
        ASSERT_EQ(scene.geometry.first_hit(from[i], directions[i], hit), !second[i].y.is_infinite()) << i;
        to.push_back(first[first.size() - 1 - i].y);
        if (second[i].y.is_infinite()) continue;
        EXPECT_EQ(second[i].y.position, hit.position);
        EXPECT_EQ(second[i].y.shape, hit.shape);
        EXPECT_NEAR(second[i].distance, glm::distance(from[i].position, hit.position), 1e-9);
        EXPECT_EQ(second[i].emission, scene.emitters.emitted(hit, -directions[i]));
    }
    std::erase_if(to, [](const SurfacePoint& p) { return p.is_infinite(); });
    from.resize(std::min(from.size(), to.size()));
    to.resize(from.size());
    const auto seen = visible(scene, from, to);
    std::size_t count = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        EXPECT_EQ(seen[i] != 0, scene.geometry.visible(from[i], to[i])) << i;
        count += seen[i] != 0;
    }
    EXPECT_TRUE(count > 0 && count < from.size());
}

// Through the lamp in the ceiling, from both sides, and through what surrounds the scene.
TEST(RayQueries, CameraSeesThroughHiddenLights) {
    Scene scene = cornell();
    const std::vector<Ray> rays{
        {Vec3(278, 1000, 280), Vec3(0, -1, 0)}, {Vec3(278, 400, 280), Vec3(0, 1, 0)}, {Vec3(100, 400, 280), Vec3(0, 1, 0)}};
    const auto shown = see_from_camera(scene, rays);
    EXPECT_NEAR(shown[0].distance, 1000.0 - 548.8, 1e-3);
    EXPECT_GT(shown[1].emission.x, 0.0);
    scene.hide_emitters = true;
    const auto hidden = see_from_camera(scene, rays);
    EXPECT_LT(hidden[0].y.position.y, 500.0);
    EXPECT_NEAR(hidden[0].distance, 1000.0 - hidden[0].y.position.y, 1e-9);
    EXPECT_GT(hidden[0].reflectance.x, 0.0);
    EXPECT_TRUE(hidden[1].y.is_infinite());
    EXPECT_EQ(hidden[1].emission, Rgb(0.0));
    EXPECT_EQ(hidden[2].y.position, shown[2].y.position);
    Scene outdoor = read_scene(SCENES "/outdoor/outdoor.xml", {{"res", "16"}});
    outdoor.hide_emitters = true;
    const std::vector<Ray> up{{Vec3(0, 1000, 0), Vec3(0, 1, 0)}};
    EXPECT_GT(see(outdoor, up).front().emission.x, 0.0);
    EXPECT_EQ(see_from_camera(outdoor, up).front().emission, Rgb(0.0));
}

// Each wall has a sixth of the area 24, shines alike, and so has a sixth of all samples.
TEST(RayQueries, SampleLightsByArea) {
    const Scene scene = furnace();
    std::vector<SurfacePoint> x;
    std::vector<Vec2> u;
    for (int i = 0; i < 100; ++i) {
        x.push_back({.position = Vec3(0.01 * i, 0.3, -0.2), .normal = Vec3(0.0), .shape = SurfacePoint::infinity});
        u.emplace_back(0.01 * i, std::fmod(0.618 * i, 1.0));
    }
    const auto lights = sample_lights(scene, x, u);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Vec3 d = lights[i].point.position - x[i].position;
        EXPECT_NEAR(lights[i].density, 1.0 / 24, 1e-12);
        EXPECT_NEAR(lights[i].pdf * std::abs(glm::dot(lights[i].w, lights[i].point.normal)) / glm::dot(d, d), 1.0 / 24, 1e-12);
        EXPECT_NEAR(lights[i].weight.x * lights[i].pdf, 1.0, 1e-12);
        EXPECT_NEAR(glm::length(d - lights[i].w * glm::length(d)), 0.0, 1e-12);
    }
    std::vector<SurfacePoint> y;
    for (const LightPoint& light : lights) y.push_back(light.point);
    for (const char seen : visible(scene, x, y)) EXPECT_EQ(seen, 1);
}

// Where the lamp faces away there is no light, but the point has its density: 1 over the lamp's area, 130 x 105 mm².
TEST(RayQueries, TellTheDensityBehindALamp) {
    const Scene scene = cornell();
    const std::vector<SurfacePoint> above{{.position = Vec3(278, 1000, 280), .normal = Vec3(0.0), .shape = SurfacePoint::infinity}};
    const auto light = sample_lights(scene, above, std::vector<Vec2>{Vec2(0.3, 0.6)}).front();
    EXPECT_EQ(light.pdf, 0.0);
    EXPECT_EQ(light.weight, Rgb(0.0));
    EXPECT_NEAR(light.density * 130 * 105, 1.0, 1e-6);
}

TEST(RayQueries, KnowWhatIsNotDiffuseAndWhatIsFarAway) {
    const Scene glass = read_scene(SCENES "/glass-ball/glass-ball.xml", {{"res", "16"}});
    std::size_t clear = 0, diffuse = 0;
    for (const SeenPoint& seen : see(glass, rays_of(glass, 1))) {
        if (seen.y.is_infinite()) continue;
        (std::isnan(seen.reflectance.x) ? clear : diffuse) += 1;
    }
    EXPECT_TRUE(clear > 0 && diffuse > 0);
    const Scene outdoor = read_scene(SCENES "/outdoor/outdoor.xml", {{"res", "16"}});
    const std::vector<SurfacePoint> x{{.position = Vec3(0, 1000, 0), .normal = Vec3(0.0), .shape = SurfacePoint::infinity}};
    const std::vector<Ray> up{{x[0].position, Vec3(0, 1, 0)}};
    EXPECT_GT(see(outdoor, up).front().emission.x, 0.0);
    const auto light = sample_lights(outdoor, x, std::vector<Vec2>{Vec2(0.5)}).front();
    EXPECT_TRUE(std::isnan(light.density));
    EXPECT_EQ(visible(outdoor, x, std::vector<SurfacePoint>{light.point}).front(), light.w.y > 0.0 ? 1 : 0);
}

TEST(RayQueries, CameraRaysOfASampleAreThoseOfItsNumber) {
    const Scene scene = furnace();
    const CameraRays all = camera_rays(scene, 0, 4, 7), later = camera_rays(scene, 2, 2, 7);
    ASSERT_EQ(all.rays.size(), 100u);
    ASSERT_EQ(later.rays.size(), 50u);
    for (std::size_t i = 0; i < later.rays.size(); ++i) {
        EXPECT_EQ(later.rays[i].direction, all.rays[50 + i].direction);
        EXPECT_EQ(later.pixels[i].x, static_cast<int>(i % 5));
        EXPECT_EQ(later.pixels[i].y, static_cast<int>(i / 5 % 5));
        EXPECT_EQ(later.weights[i], 1.0);
    }
    EXPECT_NE(all.rays[0].direction, all.rays[25].direction);
}

}  // namespace neumann::ray_queries_test
