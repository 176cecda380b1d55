// Lights that no ray meets, or that surround the scene alike on all sides: what they bring is known exactly.
#include "core/image/bitmap.h"
#include "core/sampling/sampler.h"
#include "operators/render/methods/render.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace neumann::physics::small_lights_test {

constexpr double rho = 0.7;
const Surroundings nowhere;

// Looks from `origin` along `ahead`, `up` upwards: +z, +y and +x to the left.
Mat4 facing(const Vec3& origin, const Vec3& ahead, const Vec3& up) {
    const Vec3 left = glm::normalize(glm::cross(up, ahead));
    return {glm::dvec4(left, 0), glm::dvec4(glm::cross(ahead, left), 0), glm::dvec4(ahead, 0), glm::dvec4(origin, 1)};
}

// What a floor at z = 0 shows at p by the walk's two ways that ask for lights.
void expect_reflected(const std::vector<DeltaLight>& lights, const Vec3& p, double exact, const std::string& what) {
    SceneMaker maker;
    maker.add(parallelogram({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}), matte(rho));
    maker.parts.lights.delta = lights;
    const Scene scene = maker.make();
    for (const Technique way : {Technique::mis, Technique::light}) {
        SCOPED_TRACE(what + ", " + name(way));
        expect_matches(probe(scene, at(scene, p, {0, 0, 1}), way, {.samples = 1024, .bounces = 2}), std::vector{0.0, exact, 0.0});
    }
}

// ρ I cosθ / (π d²).
TEST(SmallLights, APointLightsByTheSquareOfItsDistance) {
    expect_reflected({PointLight({1, 2, 2}, grey(5.0))}, {0, 0, 0}, rho * 5.0 * (2.0 / 3.0) / (pi * 9.0), "aside");
    expect_reflected({PointLight({1, 2, 0.01}, grey(5.0))}, {1, 2, 0}, rho * 5.0 / (pi * 1e-4), "near");
    expect_reflected({PointLight({1, 2, -1}, grey(5.0))}, {0, 0, 0}, 0.0, "behind");
}

// ρ E cosθ / π, wherever the floor is.
TEST(SmallLights, ADirectionalLightIsTheSameEverywhere) {
    const DirectionalLight sun(glm::normalize(Vec3(3, 0, -4)), grey(5.0));
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(8, -7, 0)}) expect_reflected({sun}, p, rho * 5.0 * 0.8 / pi, "from above");
    expect_reflected({DirectionalLight({0, 0, 1}, grey(5.0))}, {0, 0, 0}, 0.0, "from below");
}

// Full up to 30°, then linearly in the angle to nothing at 50°; a point at 40° gets half of it. At height 2, tan θ = x/2.
TEST(SmallLights, ASpotFallsOffLinearlyInTheAngle) {
    const Mat4 down = facing({0, 0, 2}, {0, 0, -1}, {0, 1, 0});
    const SpotLight spot(down, grey(5.0), glm::radians(50.0), glm::radians(30.0));
    for (const auto& [degrees, part] : {std::pair(0.0, 1.0), {29.9, 1.0}, {40.0, 0.5}, {45.0, 0.25}, {50.1, 0.0}, {70.0, 0.0}}) {
        const double theta = glm::radians(degrees), cosine = std::cos(theta);
        for (const double turn : {0.0, 1.0, 4.0}) {
            const Vec3 p = Vec3(std::cos(turn), std::sin(turn), 0) * (2.0 * std::tan(theta));
            expect_reflected({spot}, p, part * rho * 5.0 * cosine / pi * cosine * cosine / 4.0, std::to_string(degrees) + "°");
        }
    }
    // Without a way from full to nothing.
    const SpotLight hard(down, grey(5.0), glm::radians(50.0), glm::radians(50.0));
    EXPECT_EQ(hard.beam({2, 0, 0.01}, nowhere).irradiance.r, 5.0 / (4.0 + 1.99 * 1.99));
    EXPECT_EQ(hard.beam({3, 0, 0.01}, nowhere).irradiance.r, 0.0);
}

// As pbrt's: 3 x² − 2 x³, x linear in the cosine. On average over the cosines that is a half.
TEST(SmallLights, ASpotMayFallOffSmoothly) {
    const double from = std::cos(glm::radians(30.0)), to = std::cos(glm::radians(50.0));
    const SpotLight spot(facing({0, 0, 2}, {0, 0, -1}, {0, 1, 0}), grey(5.0), glm::radians(50.0), glm::radians(30.0), {},
                         SpotLight::Edge::smooth);
    for (const double degrees : {0.0, 29.9, 35.0, 45.0, 49.0, 50.1}) {
        const double theta = glm::radians(degrees), cosine = std::cos(theta), x = std::clamp((cosine - to) / (from - to), 0.0, 1.0);
        expect_reflected({spot}, Vec3(2.0 * std::tan(theta), 0, 0),
                         x * x * (3.0 - 2.0 * x) * rho * 5.0 * cosine / pi * cosine * cosine / 4.0, std::to_string(degrees) + "°");
    }
    EXPECT_NEAR(spot.brightness(nowhere), 2.0 * 5.0 * (1.0 - 0.5 * (from + to)), 1e-12);
}

Slide four_pixels(Bitmap::Filter filter) {
    const auto texels = std::make_shared<const Texels>(Texels{2, 2, 1, {}, {1, 2, 3, 4}});
    const Bitmap bitmap(texels, filter, Bitmap::Wrap::repeat, false);
    return {[bitmap](const Vec2& uv) { return bitmap(uv); }, 2, 2, true};
}

// The slide fills the square around the cone: u grows with the spot's own x and v with its y.
TEST(SmallLights, ASpotThrowsItsSlide) {
    const double cutoff = glm::radians(40.0), size = std::tan(cutoff);
    const SpotLight spot(Mat4(1.0), grey(5.0), cutoff, cutoff, four_pixels(Bitmap::Filter::nearest));
    const auto thrown = [&](double x, double y) {
        const Vec3 p(x * size, y * size, 1.0);
        return spot.beam(p * 3.0, nowhere).irradiance.r * 9.0 * glm::dot(p, p) / 5.0;
    };
    EXPECT_NEAR(thrown(-0.5, -0.5), 1.0, 1e-14);
    EXPECT_NEAR(thrown(0.5, -0.5), 2.0, 1e-14);
    EXPECT_NEAR(thrown(-0.5, 0.5), 3.0, 1e-14);
    EXPECT_NEAR(thrown(0.5, 0.5), 4.0, 1e-14);
}

TEST(SmallLights, ASlidesMeanIsOfItsPixels) {
    for (const auto filter : {Bitmap::Filter::nearest, Bitmap::Filter::bilinear}) EXPECT_EQ(four_pixels(filter).mean(), 2.5);
    EXPECT_EQ(Slide({1, 2, 6}).mean(), 3.0);
    EXPECT_EQ(Slide([](const Vec2& uv) { return Rgb(uv.x * uv.y); }, 64, 32, true).mean(), 0.25);
}

// A floor across the axis shows ρ E / z² wherever the picture falls; the first pixel is at +x and +y, as in a camera's film.
TEST(SmallLights, AProjectorLightsAFloorEvenly) {
    const Slide plain([](const Vec2&) { return grey(5.0); }, 2, 1, true);
    const ProjectorLight projector(facing({0, 0, 2}, {0, 0, -1}, {0, 1, 0}), plain, 1.5, 0.8);
    // The picture is 3.2 wide and 1.6 high there.
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1.59, 0.79, 0), Vec3(-1.59, 0.4, 0), Vec3(0.3, -0.79, 0)})
        expect_reflected({projector}, p, rho * 5.0 * 1.5 / 4.0, "inside");
    expect_reflected({projector}, {1.61, 0, 0}, 0.0, "beside");
    expect_reflected({projector}, {0, 0.81, 0}, 0.0, "above");

    const ProjectorLight sharp(Mat4(1.0), four_pixels(Bitmap::Filter::nearest), 1.0, 0.5);
    const auto thrown = [&](double x, double y) {
        const Vec3 p(x, y, 1.0);
        return sharp.beam(p * 3.0, nowhere).irradiance.r * 9.0 / (pi * glm::length(p));
    };
    EXPECT_NEAR(thrown(0.2, 0.2), 1.0, 1e-14);
    EXPECT_NEAR(thrown(-0.2, 0.2), 2.0, 1e-14);
    EXPECT_NEAR(thrown(0.2, -0.2), 3.0, 1e-14);
    EXPECT_NEAR(thrown(-0.2, -0.2), 4.0, 1e-14);
    EXPECT_EQ(sharp.beam({0, 0, -1}, nowhere).irradiance.r, 0.0);
}

// Brightness is the power over π: 1/π ∫ I dω over all directions, which are drawn uniformly. To 4.5 standard errors: 3 lights.
TEST(SmallLights, ChoiceIsByPower) {
    const auto expect_power = [](const auto& light) {
        constexpr int n = 1 << 16;
        double sum = 0.0, squares = 0.0;
        Sampler sampler(fixed_seed, 0);
        for (int i = 0; i < n; ++i) {
            sampler.start(static_cast<std::uint64_t>(i));
            const double x = 4.0 * mean_component(light.beam(uniform_sphere(sampler.next2()), nowhere).irradiance);
            sum += x;
            squares += x * x;
        }
        const double mean = sum / n, error = std::sqrt(std::max(squares / n - mean * mean, 0.0) / n);
        EXPECT_NEAR(light.brightness(nowhere), mean, 4.5 * error + 1e-12 * mean);
    };
    expect_power(PointLight({0, 0, 0}, {1, 2, 3}));
    expect_power(SpotLight(Mat4(1.0), {1, 2, 3}, 1.0, 0.3));
    expect_power(ProjectorLight(Mat4(1.0), four_pixels(Bitmap::Filter::bilinear), 1.5, 0.8));
}

// All kinds at once: the sum of what they bring alone, however they share the samples. A lamp of form factor 1/5 (a disc of radius
// ½ at height 1), the constant environment where the lamp does not cover it, a point and the sun; the floor is convex. 3
// comparisons by each way.
TEST(SmallLightsSlow, ShareTheSamplesOfAllLights) {
    SceneMaker maker;
    maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.01), matte(rho));
    maker.add(Disk{{0, 0, 1}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, -1}}, lamp(3.0));
    maker.parts.lights.environment = ConstantEnvironment(grey(2.0));
    maker.parts.lights.delta = {PointLight({2, 0, 1}, grey(4.0)), DirectionalLight(glm::normalize(Vec3(3, 0, -4)), grey(5.0))};
    const Scene scene = maker.make();
    const double exact = rho * (3.0 * 0.2 + 2.0 * 0.8 + 4.0 / std::sqrt(5.0) / (pi * 5.0) + 5.0 * 0.8 / pi);
    for (const Technique way : {Technique::mis, Technique::light}) {
        SCOPED_TRACE(name(way));
        expect_matches(probe(scene, at(scene, {0, 0, 0}, {0, 0, 1}), way, {.samples = 16384, .bounces = 2}),
                       std::vector{0.0, exact, 0.0});
    }
}

// Bounce 0 of a pixel is the environment where the body is not, and 0 where it is.
TEST(SmallLights, AnEnvironmentIsSeenDirectly) {
    SceneMaker maker;
    maker.add(parallelogram({-9, -9, 3}, {9, 0, 0}, {0, 18, 0}),
              matte(rho));  // behind the half x < 0, its front away from the camera
    maker.parts.lights.environment = ConstantEnvironment({1.0, 2.0, 3.0});
    maker.parts.camera.fov = 1.0;
    maker.parts.film = {4, 2, 0, 0, 4, 2, BoxFilter()};
    const Scene scene = maker.make();
    for (const Method& method : {Method(method::Walk()), Method(method::Pointwise())}) {
        const BounceSeries pictures = render(scene, method, {.bounces = 2, .samples = 16, .seed = fixed_seed});
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 4; ++x) {  // +x is to the left
                EXPECT_EQ(pictures.term(0).mean.at(x, y), x < 2 ? Rgb(1.0, 2.0, 3.0) : Rgb(0.0));
                EXPECT_EQ(pictures.term(1).mean.at(x, y), Rgb(0.0));
            }
    }
}

}  // namespace neumann::physics::small_lights_test
