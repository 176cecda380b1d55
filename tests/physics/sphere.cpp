// Inside a diffuse sphere every point sees every other alike: G is constant, K has rank one, and for any ρ(p) and Le(p)
//
//     K^i Le (p) = ρ(p) <ρ>^(i−1) <Le>,   i ≥ 1,   <·> the mean over the sphere.
//
// A chord leaves and arrives at the same angle, so for emission that depends on the angle, <Le> is 2 ∫ Le(μ) μ dμ, the mean over
// the cosine-weighted hemisphere. Since G is constant, light sampling has finite variance too.
#include "operators/known/enclosures.h"
#include "tests/physics/probe.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::physics {
namespace {

const Vec3 center(0.3, -0.7, 1.1);
constexpr double radius = 2.5;
constexpr Way all_ways[] = {Way::mis, Way::bsdf, Way::light, Way::pointwise, Way::surfaces};

Vec3 on_unit_sphere(const SurfacePoint& p) { return (p.position - center) / radius; }

Scene sphere(const SurfaceFunction& reflectance, const AreaLight& emission) {
    SceneMaker maker;
    maker.add(Sphere{center, radius, true}, {reflectance, emission});
    return maker.make();
}
// The point in direction `n` from the centre.
StartPicker at_pole(const Scene& scene, const Vec3& n) { return at(scene, center + n * radius, -n); }

std::vector<double> geometric(double first, double ratio, int count) {
    std::vector<double> values{first};
    while (static_cast<int>(values.size()) < count) values.push_back(values.back() * ratio);
    return values;
}

// The operators start anew for every term, so a few bounces of theirs have to do.
Effort effort(Way way, std::uint32_t samples) {
    return way == Way::pointwise || way == Way::surfaces ? Effort{.samples = samples, .bounces = 4}
                                                         : Effort{.samples = samples, .bounces = 8};
}

// ρ = 0.5 + 0.4 z, Le = 1 + z²: <ρ> = 1/2, <Le> = 4/3. 3 points × (3 ways × 9 + 2 × 5): to 0.4%: 111 comparisons.
TEST(SphereSlow, AlbedoAndEmissionThatVaryEnterByTheirMeans) {
    const Scene scene =
        sphere({[](const SurfacePoint& p) { return grey(0.5 + 0.4 * on_unit_sphere(p).z); }, grey(0.9)},
               {[](const SurfacePoint& p, const Vec3&) { return grey(1.0 + std::pow(on_unit_sphere(p).z, 2)); }, grey(2.0)});
    for (const double z : {-0.5, 0.5, 1.0}) {
        const Vec3 n(std::sqrt(1.0 - z * z), 0, z);
        for (const Way way : all_ways) {
            SCOPED_TRACE(name(way));
            const Effort work = effort(way, 4096);
            std::vector<double> exact = geometric((0.5 + 0.4 * z) * 4.0 / 3.0, 0.5, work.bounces);
            exact.insert(exact.begin(), 1.0 + z * z);
            expect_matches(probe(scene, at_pole(scene, n), way, work), exact, 0, 0.004);
        }
    }
}

// From outside a ray sees the outside, also where it is a tangent to all digits of a float.
TEST(Sphere, IsSeenFromItsOutsideAlongTangents) {
    SceneMaker maker;
    const Vec3 ball(0.4, 0.3, 0.2);
    maker.add(Sphere{ball, 0.3, false}, matte(0.5));
    maker.add(Cylinder{{-3, 0.3, 0.2}, {0, 0, 1}, 1.0, 0.3, false}, matte(0.5));
    const Scene scene = maker.make();
    int hits[2] = {};
    for (int i = 0; i < 20000; ++i) {
        const double turn = 0.01 * i;
        for (const std::uint32_t shape : {0u, 1u}) {
            const Vec3 n = shape == 0 ? glm::normalize(Vec3(std::cos(turn), std::sin(turn), std::sin(3.0 * turn)))
                                      : Vec3(std::cos(turn), std::sin(turn), 0.0);
            const Vec3 w = glm::normalize(shape == 0 ? glm::cross(n, Vec3(0.2, 0.5, 0.7)) : Vec3(-n.y, n.x, 0.1));
            const Vec3 touched = shape == 0 ? ball + n * 0.3 : Vec3(-3, 0.3, 0.7) + n * 0.3;
            SurfacePoint hit;
            if (!scene.geometry.first_hit(touched - w * 1.7, w, std::numeric_limits<double>::infinity(), hit) || hit.shape != shape)
                continue;
            ++hits[shape];
            EXPECT_LT(glm::dot(hit.normal, w), 0.0) << i;
        }
    }
    // About half of them pass by.
    for (const int count : hits) EXPECT_GT(count, 2000);
}

// A cap of half angle 20° with Le = 10 and ρ = 0.9: K^i Le = 10 f 0.9^i with f = (1 − cos 20°)/2, everywhere, on the cap too.
// 3 points × (3 ways × 8 + 2 × 4), to 1% by ways that look for lights, 2% by others: 96 comparisons.
TEST(SphereSlow, AGlowingCapLightsAllPlacesAlike) {
    const double edge = std::cos(pi / 9.0), f = 0.5 * (1.0 - edge);
    EXPECT_NEAR(f, 0.03015368960704584, 1e-16);
    const Scene scene =
        sphere(grey(0.9),
               {[edge](const SurfacePoint& p, const Vec3&) { return grey(on_unit_sphere(p).z > edge ? 10.0 : 0.0); }, grey(10.0)});
    for (const Vec3& n : {Vec3(0, 0, -1), Vec3(0.6, 0, 0.8), Vec3(0, 0, 1)})
        for (const Way way : all_ways) {
            SCOPED_TRACE(name(way));
            Effort work = effort(way, 8192);
            // The map from the square to the sphere takes a square to the cap, of which most nets have the same number of points:
            // no spread would be left to tell the error from.
            if (way == Way::surfaces || way == Way::light) work.sampler = SamplerKind::independent;
            expect_matches(probe(scene, at_pole(scene, n), way, work), geometric(10.0 * f * 0.9, 0.9, work.bounces), 1,
                           looks_for_lights(way) ? 0.01 : 0.02);
        }
}

// ρ = 1.6 above and 0.2 below, Le = 1: the largest albedo is above 1, <ρ> = 0.9 is not, and the series converges, K^i = 1.6 ·
// 0.9^(i−1) above. The variance of a walk grows like (mean of ρ²)^i = 1.3^i, and that of its rest is infinite: P(β > x) ~ x^−α with
// (1.6^α + 0.2)/2 = 1, α = 1.25, for roulette cuts walks where ρ < 1 and leaves β alone. ρ = 2 above would make <ρ> = 1.1 and the
// series diverge. 2 points × (3 ways × 6 + 2 × 4), to 1%: 52 comparisons.
TEST(SphereSlow, AnAlbedoAboveOneMayStillConverge) {
    const Scene scene =
        sphere({[](const SurfacePoint& p) { return grey(on_unit_sphere(p).z > 0.0 ? 1.6 : 0.2); }, grey(1.6)}, grey(1.0));
    EXPECT_EQ(scene.warnings.counts().count("reflectance above 1: a surface gives back more light than it receives"), 1u);
    for (const double z : {0.5, -0.5})
        for (const Way way : all_ways) {
            SCOPED_TRACE(name(way));
            Effort work = effort(way, 8192);
            work.bounces = std::min(work.bounces, 6);
            expect_matches(probe(scene, at_pole(scene, {std::sqrt(0.75), 0, z}), way, work),
                           geometric(z > 0.0 ? 1.6 : 0.2, 0.9, work.bounces), 1, 0.01);
        }
}

TEST(Sphere, TheRestUnderAnAlbedoAboveOneRaisesTheAlarm) {
    const Scene scene =
        sphere({[](const SurfacePoint& p) { return grey(on_unit_sphere(p).z > 0.0 ? 1.6 : 0.2); }, grey(1.6)}, grey(1.0));
    const Estimates found = probe(scene, at_pole(scene, {0, 0, 1}), Way::bsdf,
                                  {.samples = 8192, .bounces = 4, .rest_probability = 1.0, .sampler = SamplerKind::independent});
    const auto tail = tail_index(found.largest.back());
    ASSERT_TRUE(tail);
    EXPECT_TRUE(tail->variance_is_infinite()) << "tail index " << tail->alpha;
}

// Le(μ) = μ²: <Le> = 1/2, so K^i Le = ρ^i / 2. Le(μ) = 1 − μ: 1/3. 2 × (3 ways × 8 + 2 × 4), to 0.4%: 64 comparisons.
TEST(SphereSlow, EmissionThatDependsOnTheAngleEntersByItsCosineMean) {
    struct {
        double (*Le)(double);
        double mean;
    } const cases[] = {{[](double mu) { return mu * mu; }, 0.5}, {[](double mu) { return 1.0 - mu; }, 1.0 / 3.0}};
    for (const auto& [Le, mean] : cases) {
        const Scene scene = sphere(
            grey(0.8), {[Le = Le](const SurfacePoint& p, const Vec3& w) { return grey(Le(glm::dot(p.normal, w))); }, grey(1.0)});
        for (const Way way : all_ways) {
            SCOPED_TRACE(name(way));
            const Effort work = effort(way, 4096);
            expect_matches(probe(scene, at_pole(scene, {0.36, 0.48, 0.8}), way, work), geometric(mean * 0.8, 0.8, work.bounces), 1,
                           0.004);
        }
    }
}

}  // namespace
}  // namespace neumann::physics
