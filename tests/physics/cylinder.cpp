// Cylinders: where rays hit, and the tube whose light is known.
#include "core/base/error.h"
#include "core/sampling/sampler.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::physics::cylinder_test {

// In a skew position, where nothing has a short binary form.
Cylinder skew(bool flip_normals = false) {
    return {{0.3, -1.7, 2.1}, glm::normalize(Vec3(0.3, -0.5, 0.7)), 2.3, 0.6, flip_normals};
}
double along(const Cylinder& c, const Vec3& p) { return glm::dot(p - c.base, c.axis); }
Vec3 across(const Cylinder& c, const Vec3& p) { return p - c.base - c.axis * along(c, p); }

void expect_on(const Cylinder& c, const SurfacePoint& p, const std::string& what) {
    EXPECT_NEAR(glm::length(across(c, p.position)), c.radius, 1e-14 * c.radius + 1e-15 * glm::length(c.base)) << what;
    EXPECT_GE(along(c, p.position), 0.0) << what;
    EXPECT_LE(along(c, p.position), c.length) << what;
    const Vec3 outwards = across(c, p.position) / c.radius;
    EXPECT_NEAR(glm::length(p.normal - (c.flip_normals ? -outwards : outwards)), 0.0, 1e-14) << what;
}

TEST(Cylinder, HasItsAreaAndIsCoveredEvenly) {
    for (const bool flip : {false, true}) {
        const Cylinder c = skew(flip);
        const Geometry geometry({c});
        EXPECT_DOUBLE_EQ(geometry.area(0), 2.0 * pi * 0.6 * 2.3);
        EXPECT_EQ(geometry.primitive_count(0), 1u);
        // A square of parameters: u runs along the axis, v around it, at the same pace everywhere.
        const Vec3 start = across(c, geometry.point(0, 0, {0.5, 0.0}).position);
        for (int i = 0; i < 16; ++i)
            for (int j = 0; j < 16; ++j) {
                const Vec2 uv((j + 0.5) / 16.0, i / 16.0);
                const SurfacePoint p = geometry.point(0, 0, uv);
                expect_on(c, p, "point");
                EXPECT_NEAR(along(c, p.position), uv.x * c.length, 1e-14);
                EXPECT_NEAR(glm::dot(across(c, p.position), start), c.radius * c.radius * std::cos(2.0 * pi * uv.y), 1e-12);
                EXPECT_NEAR(glm::dot(glm::cross(start, across(c, p.position)), c.axis),
                            c.radius * c.radius * std::sin(2.0 * pi * uv.y), 1e-12);
            }
    }
}

// The roots of |o⊥ + t d⊥| = r that lie between the ends, by the quadratic formula: the first one is hit, from outside and inside.
TEST(Cylinder, IsHitWhereTheQuadraticSays) {
    const Cylinder c = skew();
    const Geometry geometry({c});
    Sampler sampler(fixed_seed, 0);
    int hits = 0, from_inside = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
        sampler.start(i);
        const Vec3 away = uniform_sphere(sampler.next2()), d = uniform_sphere(sampler.next2());
        const Vec3 o = c.center() + away * (2.0 * sampler.next());
        const Vec3 p = across(c, o), q = across(c, c.base + d);
        const double A = glm::dot(q, q), B = 2.0 * glm::dot(p, q), C = glm::dot(p, p) - c.radius * c.radius,
                     D = B * B - 4.0 * A * C;
        double expected = -1.0;
        bool doubtful = std::abs(D) < 1e-5;
        if (D > 0.0)
            for (const double t : {(-B - std::sqrt(D)) / (2.0 * A), (-B + std::sqrt(D)) / (2.0 * A)}) {
                const double s = along(c, o + t * d);
                doubtful |= std::abs(t) < 1e-5 || std::abs(s) < 1e-5 || std::abs(s - c.length) < 1e-5;
                if (expected < 0.0 && t > 0.0 && s >= 0.0 && s <= c.length) expected = t;
            }
        if (doubtful) continue;
        SurfacePoint hit;
        ASSERT_EQ(geometry.first_hit(o, d, 100.0, hit), expected > 0.0) << i;
        if (expected < 0.0) continue;
        ++hits;
        from_inside += C < 0.0;
        expect_on(c, hit, "hit");
        EXPECT_NEAR(glm::length(hit.position - (o + expected * d)), 0.0, 1e-11);
    }
    EXPECT_GT(hits - from_inside, 1000);
    EXPECT_GT(from_inside, 1000);
}

// Along the axis there is nothing to hit, inside or on the surface itself.
TEST(Cylinder, IsOpenAtItsEnds) {
    const Geometry geometry({Cylinder{{0, 0, 0}, {0, 0, 1}, 1.0, 0.5, true}});
    SurfacePoint hit;
    for (const double x : {0.0, 0.2, 0.499, 0.5, 0.6})
        for (const double side : {-1.0, 1.0}) EXPECT_FALSE(geometry.first_hit({x, 0, 0.5 - side}, {0, 0, side}, 1e9, hit));
    EXPECT_FALSE(geometry.first_hit({0, 0, -1.0}, glm::normalize(Vec3(0.2, 0, 1.0)), 1e9, hit));
    EXPECT_TRUE(geometry.first_hit({0, 0, -1.0}, glm::normalize(Vec3(0.3, 0, 1.0)), 1e9, hit));
}

// From point to point inside, and back: V is symmetric, and what is hit is the other point, unless a float ray that grazes the wall
// may leave by an end instead.
TEST(Cylinder, PointsInsideSeeEachOther) {
    const Cylinder c = skew(true);
    const Geometry geometry({c});
    Sampler sampler(fixed_seed, 1);
    for (std::uint64_t i = 0; i < 20000; ++i) {
        sampler.start(i);
        const SurfacePoint x = geometry.point(0, 0, sampler.next2()), y = geometry.point(0, 0, sampler.next2());
        EXPECT_TRUE(geometry.visible(x, y) && geometry.visible(y, x));
        const Vec3 d = y.position - x.position;
        SurfacePoint hit;
        const double end = std::min(along(c, y.position), c.length - along(c, y.position));
        if (glm::dot(d, x.normal) < 1e-3 || end < 1e-3) continue;
        ASSERT_TRUE(geometry.first_hit(x, glm::normalize(d), hit));
        EXPECT_NEAR(glm::length(hit.position - y.position), 0.0, 1e-11);
    }
}

TEST(Cylinder, WithoutExtentIsLeftOut) {
    const Geometry geometry({Cylinder{.length = 0.0}, Cylinder{.radius = 0.0}});
    EXPECT_EQ(geometry.degenerate_count(), 2u);
    EXPECT_EQ(geometry.area(0), 0.0);
    EXPECT_EQ(geometry.area(1), 0.0);
    EXPECT_THROW(Geometry({Cylinder{.radius = INFINITY}}), InputError);
}

// An open tube as wide as long under a sky of 1. What comes in through the ends is what two glowing discs there would send.
Scene tube(double rho, const Vec3& to = Vec3(0.0), double scale = 1.0) {
    const double r = 0.5 * scale;
    SceneMaker maker;
    maker.add(Cylinder{to, {0, 0, 1}, scale, r, true}, matte(rho));
    maker.add(Disk{to, {r, 0, 0}, {0, r, 0}, {0, 0, 1}}, lamp(1.0));
    maker.add(Disk{to + Vec3(0, 0, scale), {r, 0, 0}, {0, r, 0}, {0, 0, -1}}, lamp(1.0));
    return maker.make();
}

// The same random numbers make the same walks: with lengths times a power of two the same bits, elsewhere up to rounding.
TEST(Cylinder, ScaleAndPlaceDoNotMatter) {
    const auto terms = [](const Vec3& to, double scale) {
        const Scene scene = tube(0.9, to, scale);
        return probe(scene, at(scene, to + Vec3(0.5, 0, 0.3) * scale, {-1, 0, 0}, 1e-3 * scale), Technique::mis,
                     {.samples = 64, .bounces = 6});
    };
    const Estimates one = terms({0, 0, 0}, 1.0);
    for (const double scale : {0x1p-20, 0x1p20}) {
        const Estimates other = terms({0, 0, 0}, scale);
        for (std::size_t i = 0; i <= 6; ++i) EXPECT_EQ(one.terms[i].mean.r, other.terms[i].mean.r) << "K^" << i << " Le";
    }
    struct {
        Vec3 to;
        double scale;
    } const places[] = {{{1.1e5, -0.7e5, 0.3e5}, 1.0}, {{0.123, 4.56, -7.89}, 1e-6}, {{-12.3, 4.56, 7.89}, 1e6}};
    for (const auto& [to, scale] : places) {
        const Estimates other = terms(to, scale);
        for (std::size_t i = 0; i <= 6; ++i)
            EXPECT_NEAR(other.terms[i].mean.r, one.terms[i].mean.r, 1e-6 * one.terms[i].mean.r) << "K^" << i << " Le, " << scale;
    }
}

}  // namespace neumann::physics::cylinder_test
