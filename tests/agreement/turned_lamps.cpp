// Lamps that reflect, turned at random: what a light is when it is seen from its own plane is not for rounding to decide.
#include "core/base/error.h"
#include "core/base/frame.h"
#include "core/sampling/sampler.h"
#include "core/sampling/warp.h"
#include "operators/experiments/known/scene_maker.h"
#include "tests/agreement/every_method.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <cstdlib>

namespace neumann::turned_lamps_test {

using namespace known;

class Numbers {
public:
    explicit Numbers(std::uint64_t seed) : sampler_(seed, 0) { sampler_.start(0); }
    double operator()() { return sampler_.next(); }
    double between(double low, double high) { return low + (high - low) * (*this)(); }

private:
    Sampler sampler_;
};

Mat4 turned(Numbers& u) {
    const double z = u.between(-1.0, 1.0), phi = u.between(0.0, 2.0 * pi), r = std::sqrt(1.0 - z * z);
    return glm::rotate(Mat4(1.0), u.between(0.0, 2.0 * pi), Vec3(r * std::cos(phi), r * std::sin(phi), z));
}

Shape lamp_of(int kind, const Mat4& to_world) {
    switch (kind) {
        case 0:
            return transformed(parallelogram({-0.5, -0.4, 0}, {1, 0, 0}, {0, 0.8, 0}), to_world);
        case 1:
            return transformed(triangle({-0.5, -0.4, 0}, {0.6, -0.3, 0}, {0, 0.7, 0}), to_world);
        case 2:
            return transformed(box({-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}), to_world);
        default:
            return transformed(Disk{{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}}, to_world);
    }
}

// One to three lamps over a floor, perhaps under a sky.
Scene scene_of(std::uint64_t seed) {
    Numbers u(seed);
    SceneMaker maker;
    maker.add(parallelogram({-2, -2, -1}, {4, 0, 0}, {0, 4, 0}), matte(0.5));
    const int lamps = 1 + static_cast<int>(3.0 * u());
    for (int i = 0; i < lamps; ++i) {
        const Mat4 place = glm::translate(Mat4(1.0), Vec3(1.2 * (i - 0.5 * (lamps - 1)), 0.0, 0.3)) * turned(u);
        maker.add(lamp_of(static_cast<int>(4.0 * u()), place), glowing(0.8, u.between(0.5, 2.0)));
    }
    if (u() < 0.5) maker.parts.lights.environment = ConstantEnvironment(grey(1.0));
    maker.parts.camera = {.to_world = glm::inverse(glm::lookAt(Vec3(1, -4, 2.5), Vec3(0, 0, -0.2), Vec3(0, 0, 1))) *
                                      glm::scale(Mat4(1.0), Vec3(-1, 1, -1)),
                          .fov = 0.9,
                          .near_clip = 1e-3};
    maker.parts.film = {8, 8, 0, 0, 8, 8};
    return maker.make();
}

// NEUMANN_TURNED_LAMPS scenes, or 8. No method crashes or hangs, and bounces 1 and 2 are those of the walk within 5.5 standard
// errors and the stated discretisation: a false alarm in about 1 of 2000 runs, as replicates are few (t of 15 degrees of freedom).
// Passed with 1000 scenes.
TEST(TurnedLampsSlow, LightByEveryMethodAsByWalks) {
    const char* const asked = std::getenv("NEUMANN_TURNED_LAMPS");
    const std::uint64_t scenes = asked ? std::strtoull(asked, nullptr, 10) : 8;
    for (std::uint64_t number = 0; number < scenes; ++number) {
        const Scene scene = scene_of(physics::fixed_seed + number);
        Goal goal = agreement::pictures(2, 1024);
        const BounceSeries walk = render(scene, method::Walk{}, goal);
        goal.seed += 1;
        goal.samples = 128;
        for (const Method& method : agreement::every_method()) {
            SCOPED_TRACE("scene " + std::to_string(number) + ", " + std::string(name_of(method)));
            const BounceSeries found = render(scene, method, goal);
            for (const std::size_t bounce : {1u, 2u}) {
                const auto a = agreement::mean_of_bounce(found, bounce), b = agreement::mean_of_bounce(walk, bounce);
                EXPECT_NEAR(a.mean.mean, b.mean.mean,
                            5.5 * std::hypot(a.mean.standard_error, b.mean.standard_error) + 2.0 * a.bias + 1e-9)
                    << "bounce " << bounce;
            }
        }
    }
}

// Where nothing else is, light comes back to a lamp from the sky alone: a flat lamp does not light itself, however it is turned.
// The exact value is ρ · 1.
TEST(TurnedLampsSlow, DoNotLightThemselves) {
    for (std::uint64_t number = 0; number < 9; ++number) {
        Numbers u(physics::fixed_seed + number);
        SceneMaker maker;
        const Mat4 turn = turned(u);
        const int kinds[] = {0, 1, 3};
        maker.add(lamp_of(kinds[number % 3], turn), glowing(0.8, 100.0));
        maker.parts.lights.environment = ConstantEnvironment(grey(1.0));
        const Vec3 normal(turn * glm::dvec4(0, 0, 1, 0)), up(turn * glm::dvec4(0, 1, 0, 0));
        maker.parts.camera = {
            .to_world = glm::inverse(glm::lookAt(3.0 * normal, Vec3(0.0), up)) * glm::scale(Mat4(1.0), Vec3(-1, 1, -1)),
            .fov = 0.08,
            .near_clip = 1e-3};
        maker.parts.film = {2, 2, 0, 0, 2, 2};
        const Scene scene = maker.make();
        Goal goal = agreement::pictures(2, 64);
        for (const Method& method : agreement::every_method()) {
            SCOPED_TRACE("scene " + std::to_string(number) + ", " + std::string(name_of(method)));
            if (std::holds_alternative<method::Light>(method)) continue;  // nearly all of its paths begin on the lamp
            const BounceSeries found = render(scene, method, goal);
            const auto first = agreement::mean_of_bounce(found, 1), second = agreement::mean_of_bounce(found, 2);
            EXPECT_NEAR(first.mean.mean, 0.8, 5.5 * first.mean.standard_error + 2.0 * first.bias + 1e-9);
            EXPECT_NEAR(second.mean.mean, 0.0, 1e-12);
        }
    }
}

}  // namespace neumann::turned_lamps_test
