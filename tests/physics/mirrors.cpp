// Mirrors: light goes one way only, so that every term is a product along a path that geometry gives, without variance, in
// whichever way lights are looked for.
#include "core/base/error.h"
#include "core/sampling/warp.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>
#include <algorithm>

namespace neumann::physics {
namespace {

constexpr Way ways[] = {Way::mis, Way::bsdf, Way::light, Way::pointwise};
constexpr double rho = 0.9;

Conductor mirror() { return Conductor({}, grey(rho)); }

// What is seen from `origin` along `direction`.
StartPicker seen(const Scene& scene, const Vec3& origin, const Vec3& direction) {
    const Vec3 d = glm::normalize(direction);
    SurfacePoint p;
    if (!scene.geometry.first_hit(origin, d, 1e9, p)) throw std::logic_error("there is no surface here");
    return [start = Start{p, -d}](Random&) { return start; };
}

// Few samples are enough: all have to be the same.
Effort effort(Way way, int bounces) { return {.samples = 2, .bounces = way == Way::pointwise ? std::min(bounces, 12) : bounces}; }

void expect_terms(const Estimates& found, const std::function<Rgb(int)>& exact, double tolerance) {
    for (std::size_t i = 0; i < found.terms.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(found.terms[i].mean[c], exact(static_cast<int>(i))[c], tolerance) << "K^" << i << " Le, channel " << c;
            EXPECT_EQ(found.terms[i].standard_error[c], 0.0) << "K^" << i << " Le, channel " << c;
        }
}

// A ray in a cube of mirrors goes straight on through the cube's mirror images. Le is the position, as a colour.
TEST(Mirrors, InACubePathsAreUnfolded) {
    const Vec3 origin(0.3, 0.4, 0.5), direction(1.0, 0.7, 0.45);
    constexpr int faces[] = {1, 3, 5, 0, 2, 1, 4, 0, 3, 1, 2, 5, 0, 3, 1, 0, 4, 2, 1, 3, 0,
                             5, 1, 2, 0, 4, 3, 1, 0, 2, 5, 1, 3, 0, 2, 4, 1, 0, 3, 1, 5};
    // Where the unfolded ray crosses the i-th wall, folded back.
    const auto point = [&](int i) {
        std::vector<double> crossings;
        for (int axis = 0; axis < 3; ++axis)
            for (int wall = 1; wall <= 60; ++wall) crossings.push_back((wall - origin[axis]) / direction[axis]);
        std::sort(crossings.begin(), crossings.end());
        const Vec3 x = origin + direction * crossings.at(static_cast<std::size_t>(i));
        return glm::abs(x - 2.0 * glm::round(0.5 * x));
    };
    SceneMaker maker;
    for (const TriangleMesh& face : room({0, 0, 0}, {1, 1, 1}))
        maker.add(face, made_of(mirror(), AreaLight([](const ShadingPoint& p, const Vec3&) { return p.position; }, grey(1.0))));
    const Scene scene = maker.make();
    for (const Way way : ways) {
        SCOPED_TRACE(name(way));
        const Estimates found = probe(scene, seen(scene, origin, direction), way, effort(way, 40));
        expect_terms(
            found, [&](int i) { return std::pow(rho, i) * point(i); }, 1e-12);
        for (std::size_t i = 0; i < found.terms.size(); ++i) {
            const int axis = faces[i] / 2, side = faces[i] % 2;
            EXPECT_NEAR(found.terms[i].mean[axis], side * std::pow(rho, i), 1e-12) << "face " << faces[i] << " at bounce " << i;
        }
    }
}

// In a sphere a ray goes round in equal steps α = π − 2θ: with Le = 1 + cos 3φ, K^i Le = ρ^i (1 + cos 3iα). The rest is known too.
TEST(Mirrors, InASphereTermsRotate) {
    const double theta = 37.0 * pi / 180.0, alpha = pi - 2.0 * theta;
    SceneMaker maker;
    maker.add(
        Sphere{{0, 0, 0}, 1.0, true},
        made_of(mirror(), AreaLight([](const ShadingPoint& p,
                                       const Vec3&) { return grey(1.0 + std::cos(3.0 * std::atan2(p.position.y, p.position.x))); },
                                    grey(2.0))));
    const Scene scene = maker.make();
    const auto exact = [&](int i) { return std::pow(rho, i) * (1.0 + std::cos(3.0 * i * alpha)); };
    EXPECT_NEAR(exact(7), 0.67283778, 1e-8);
    const Vec3 towards(-std::cos(theta), std::sin(theta), 0.0);
    for (const Way way : ways) {
        SCOPED_TRACE(name(way));
        const auto start = seen(scene, Vec3(1, 0, 0) + 0.5 * towards, -towards);
        expect_terms(
            probe(scene, start, way, effort(way, 60)), [&](int i) { return grey(exact(i)); }, 1e-10);
    }
    // Roulette ends the walks, so the rest has a variance. 1 comparison.
    const Estimates found = probe(scene, seen(scene, Vec3(1, 0, 0) + 0.5 * towards, -towards), Way::mis,
                                  {.samples = 4096, .bounces = 8, .rest_probability = 1.0});
    double rest = 10.701126599366;
    for (int i = 0; i <= 8; ++i) rest -= exact(i);
    expect_matches(found.rest, rest, "rest", 0.004);
}

// In a prism over an equilateral triangle the path through the middles of the sides closes after three bounces.
TEST(Mirrors, InATriangleEveryThirdTermIsNotZero) {
    const Vec3 corner[] = {{1, 0, 0}, {-0.5, std::sqrt(0.75), 0}, {-0.5, -std::sqrt(0.75), 0}};
    SceneMaker maker;
    for (int side = 0; side < 3; ++side) {
        const Vec3 a = corner[side], b = corner[(side + 1) % 3];
        maker.add(parallelogram(a - Vec3(0, 0, 1), Vec3(0, 0, 2.5), b - a),
                  made_of(mirror(), side == 0 ? std::optional<AreaLight>(grey(1.0)) : std::nullopt));
    }
    const Scene scene = maker.make();
    const Vec3 middle = 0.5 * (corner[0] + corner[1]), before = 0.5 * (corner[2] + corner[0]);
    for (const Way way : ways) {
        SCOPED_TRACE(name(way));
        expect_exact(probe(scene, seen(scene, before + 0.1 * (middle - before), middle - before), way, effort(way, 36)),
                     [](int i) { return grey(i % 3 == 0 ? std::pow(rho, i) : 0.0); });
    }
}

// m mirrors at 45° in a zigzag, and a lamp behind the last one: the only term is K^m Le = ρ^m Le.
TEST(Mirrors, APeriscopeOfManyMirrorsHasOneTerm) {
    for (int m = 1; m <= 5; ++m) {
        SceneMaker maker;
        // Light is followed along +x into the first mirror, up to the second, along +x, …
        Vec3 at(0.0), along(1, 0, 0), across(0, 0, 1);
        for (int k = 0; k < m; ++k) {
            maker.add(patch(at, glm::normalize(across - along), 0.3), made_of(mirror()));
            std::swap(along, across);
            at += along;
        }
        maker.add(patch(at, -along, 0.2), lamp(2.0));
        const Scene scene = maker.make();
        for (const Way way : ways) {
            SCOPED_TRACE(name(way) + ", mirrors: " + std::to_string(m));
            const Estimates found = probe(scene, seen(scene, {-1, 0.01, 0.02}, {1, 0, 0}), way, effort(way, 8));
            expect_exact(found, [m](int i) { return grey(i == m ? 2.0 * std::pow(rho, m) : 0.0); });
        }
    }
}

// A diffuse floor lit by a lamp that it sees in a mirror only, as if the lamp were behind it: K^2 Le = ρ_floor ρ F, F the form
// factor of the mirrored lamp, here of a disc at height h seen from a point below its centre, r²/(r² + h²), less
// s²/(π h²) of the floor itself, a small square that hides a little of the lamp. Light sampling has to find it by walking on. 3
// ways, to 0.5%: 3 comparisons.
TEST(Mirrors, ALampSeenInAMirrorLightsTheFloor) {
    SceneMaker maker;
    maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.01), matte(0.5));
    maker.add(patch({0, 0, 1}, {0, 0, -1}, 1.0), made_of(mirror()));
    maker.add(Disk{{0, 0, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}}, lamp(1.0));
    const Scene scene = maker.make();
    const double F = 4.0 / (4.0 + 9.0) - 0.02 * 0.02 / (pi * 4.0);
    for (const Way way : {Way::mis, Way::bsdf, Way::light}) {
        SCOPED_TRACE(name(way));
        expect_matches(probe(scene, at(scene, {0, 0, 0}, {0, 0, 1}), way, {.samples = 16384, .bounces = 3}),
                       std::vector{0.0, 0.0, 0.5 * rho * F, 0.0}, 0, 0.005);
    }
}

TEST(Mirrors, TheBackIsBlackUnlessTwoSided) {
    for (const bool two_sided : {false, true}) {
        SceneMaker maker;
        Surface surface = made_of(mirror());
        surface.two_sided = two_sided;
        maker.add(patch({0, 0, 0}, {0, 0, 1}, 1.0), surface);
        maker.add(patch({0, 0, -2}, {0, 0, 1}, 1.0), lamp(1.0));
        const Scene scene = maker.make();
        for (const Way way : ways) {
            const Estimates found = probe(scene, seen(scene, {0.1, 0.2, -1}, {0, 0, 1}), way, effort(way, 2));
            expect_exact(found, [=](int i) { return grey(two_sided && i == 1 ? rho : 0.0); });
        }
    }
}

TEST(Mirrors, ReflectionOverSurfacesRefusesThem) {
    SceneMaker maker;
    maker.add(patch({0, 0, 0}, {0, 0, 1}, 1.0), made_of(mirror(), grey(1.0)));
    const Scene scene = maker.make();
    try {
        probe(scene, at(scene, {0.1, 0.2, 0}, {0, 0, 1}), Way::surfaces, {.samples = 1, .bounces = 1});
        FAIL();
    } catch (const InputError& e) {
        EXPECT_STREQ(e.what(), "reflection over surfaces is not possible with mirrors, expected diffuse or rough materials");
    }
}

}  // namespace
}  // namespace neumann::physics
