// Measures of polygons seen from a point, and directions to them.
#include "core/sampling/projected_polygon.h"
#include "core/sampling/sampler.h"
#include "core/sampling/spherical_rectangle.h"
#include "core/sampling/spherical_triangle.h"
#include "core/sampling/warp.h"
#include "operators/fields/matrix/light_vector.h"
#include "operators/fields/matrix/sides.h"
#include "tests/physics/cell_counts.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>
#include <algorithm>

namespace neumann::physics::polygons_seen_test {

constexpr int cells = 16, drawn = 1 << 16;

// The probability that χ² is larger than of these counts in cells × cells parts of a rectangle. `expected` counts in the part that
// begins at the corner + s a + t b; parts with fewer than 10 are joined.
template <class Sample, class Expected>
double chi_squared_test(const Vec3& corner, const Vec3& a, const Vec3& b, const Sample& sample, const Expected& expected) {
    std::vector<double> found(cells * cells);
    Sampler sampler(fixed_seed, 3);
    for (int i = 0; i < drawn; ++i) {
        sampler.start(static_cast<std::uint64_t>(i));
        const Vec3 d = sample(sampler.next2()) - corner;
        const int s = static_cast<int>(cells * glm::dot(d, a) / glm::dot(a, a)),
                  t = static_cast<int>(cells * glm::dot(d, b) / glm::dot(b, b));
        ++found[static_cast<std::size_t>(std::clamp(s, 0, cells - 1) * cells + std::clamp(t, 0, cells - 1))];
    }
    CellCounts counts;
    for (int s = 0; s < cells; ++s)
        for (int t = 0; t < cells; ++t) {
            const Vec3 part_a = a / double(cells), part_b = b / double(cells);
            const double wanted = drawn * expected(corner + double(s) * part_a + double(t) * part_b, part_a, part_b);
            counts.add(found[static_cast<std::size_t>(s * cells + t)], wanted);
        }
    counts.join_few();
    EXPECT_GT(counts.cells, 3);
    return counts.p();
}

// Of a triangle, Girard's formula for an octant, and a small flat one.
TEST(PolygonsSeen, SolidAngles) {
    EXPECT_NEAR(solid_angle({2, 0, 0}, {0, 3, 0}, {0, 0, 0.5}), 0.5 * pi, 1e-15);
    EXPECT_NEAR(solid_angle({0, 0, 1000}, {1, 0, 1000}, {0, 1, 1000}) / 0.5e-6, 1.0, 1e-5);
    EXPECT_EQ(solid_angle({1, 0, 0}, {2, 1, 0}, {2, -1, 0}), 0.0);
}

// Uniform in solid angle: the mean direction is half the sum of the sides' angles times their normals, over the solid angle
// (Stokes).
TEST(PolygonsSeen, SphericalTrianglesAreSampledUniformly) {
    const auto side = [](const Vec3& p, const Vec3& q) {
        const Vec3 n = glm::cross(p, q);
        return n * (std::atan2(glm::length(n), glm::dot(p, q)) / glm::length(n));
    };
    for (const auto& [a, b, c] : {std::array{Vec3(-0.4, -0.3, 1), Vec3(0.9, -0.2, 1), Vec3(0.1, 0.7, 1)},
                                  std::array{Vec3(-0.4, -0.3, 0.05), Vec3(0.5, -0.3, 0.3), Vec3(0.1, 0.7, 0.1)}}) {
        const double angle = solid_angle(a, b, c);
        const Vec3 exact = (side(a, b) + side(b, c) + side(c, a)) * (0.5 / angle);
        Vec3 mean(0.0), squares(0.0);
        constexpr int n = 1 << 16;
        Sampler sampler(fixed_seed, 1);
        for (int i = 0; i < n; ++i) {
            sampler.start(static_cast<std::uint64_t>(i));
            const Vec3 w = sample_spherical_triangle(a, b, c, angle, sampler.next2());
            EXPECT_NEAR(glm::length(w), 1.0, 1e-12);
            mean += w / double(n);
            squares += w * w / double(n);
        }
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(mean[k], std::copysign(1.0, glm::dot(mean, exact)) * exact[k],
                        4.5 * std::sqrt((squares[k] - mean[k] * mean[k]) / n));
    }
}

// A face of a cube from its middle; from points of all kinds, flat ones among them, against the sum over the corners of
// ± atan(x y / (h r)), and against the sum of two triangles. At a height h rounding of the corners alone moves it by up to ε/h.
TEST(PolygonsSeen, SolidAnglesOfRectangles) {
    EXPECT_NEAR(SphericalRectangle({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}).solid_angle(), 4.0 * pi / 6.0, 1e-14);
    EXPECT_EQ(SphericalRectangle({1, -1, 0}, {2, 0, 0}, {0, 2, 0}).solid_angle(), 0.0);
    Sampler sampler(fixed_seed, 2);
    sampler.start(0);
    const auto number = [&] { return 4.0 * sampler.next() - 2.0; };
    for (int i = 0; i < 1000; ++i) {
        const double x = number(), y = number(), height = std::abs(number()) * std::pow(10.0, -(i % 6));
        const Vec3 corner(x, y, height), a(std::abs(number()), 0, 0), b(0, std::abs(number()), 0);
        const auto at_corner = [&](double s, double t) {
            return std::atan2(s * t, height * std::sqrt(s * s + t * t + height * height));
        };
        const double corners = at_corner(x + a.x, y + b.y) - at_corner(x, y + b.y) - at_corner(x + a.x, y) + at_corner(x, y);
        const double triangles = solid_angle(corner, corner + a, corner + b) + solid_angle(corner + a, corner + a + b, corner + b);
        const double found = SphericalRectangle(corner, a, b).solid_angle();
        EXPECT_NEAR(found, corners, 1e-14 / std::min(height, 1.0));
        EXPECT_NEAR(found, triangles, 1e-14 / std::min(height, 1.0));
    }
}

// χ² of 2^16 points in 16 × 16 cells of the rectangle, whose solid angles are those of rectangles. 4 comparisons, each with the
// false-alarm rate of |z| > 4.5, 6.8e-6.
TEST(PolygonsSeen, SphericalRectanglesAreSampledUniformly) {
    for (const auto& [corner, a, b] : {std::array{Vec3(-0.4, -0.3, 1), Vec3(1.3, 0, 0), Vec3(0, 0.9, 0)},
                                       std::array{Vec3(0.5, 0.2, -0.4), Vec3(0, 2, 0), Vec3(0, 0, 0.7)},
                                       std::array{Vec3(0.3, -1.0, 0.02), Vec3(2, 0, 0), Vec3(0, 3, 0)},
                                       std::array{Vec3(-1, -1, 1e-3), Vec3(2, 0, 0), Vec3(0, 2, 0)}}) {
        const SphericalRectangle rectangle(corner, a, b);
        EXPECT_GT(chi_squared_test(
                      corner, a, b, [&](const Vec2& u) { return rectangle.sample(u); },
                      [&](const Vec3& c, const Vec3& s, const Vec3& t) {
                          return SphericalRectangle(c, s, t).solid_angle() / rectangle.solid_angle();
                      }),
                  6.8e-6);
    }
}

std::array<Vec3, 4> corners(const Vec3& corner, const Vec3& a, const Vec3& b) {
    return {corner, corner + a, corner + a + b, corner + b};
}

// A unit square overhead, its corner at the zenith at height 1, and one that stands upright before the point, whose other half is
// below the horizon: π times the form factors of a point and a parallel and a perpendicular rectangle (Howell, A Catalog of
// Radiation Heat Transfer Configuration Factors, B-4 and B-3).
TEST(PolygonsSeen, ProjectedSolidAngles) {
    EXPECT_NEAR(ProjectedPolygon(corners({0, 0, 1}, {1, 0, 0}, {0, 1, 0}), {0, 0, 1}).area(), pi * 0.1385316059948930, 1e-14);
    EXPECT_NEAR(ProjectedPolygon(corners({0, 0, -1}, {1, 0, 0}, {0, 1, 0}), {0, 0, -1}).area(), pi * 0.1385316059948930, 1e-14);
    EXPECT_EQ(ProjectedPolygon(corners({0, 0, 1}, {1, 0, 0}, {0, 1, 0}), {0, 0, -1}).area(), 0.0);
    // A strip from 0 to 1 at distance 1, from the horizon to height 1.
    const double upright = 0.5 * (std::atan(1.0) - std::atan(1.0 / std::sqrt(2.0)) / std::sqrt(2.0));
    EXPECT_NEAR(ProjectedPolygon(corners({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), {0, 0, 1}).area(), upright, 1e-14);
    EXPECT_NEAR(ProjectedPolygon(corners({1, 0, -3}, {0, 1, 0}, {0, 0, 4}), {0, 0, 1}).area(), upright, 1e-14);
    // The hemisphere, nearly.
    EXPECT_NEAR(ProjectedPolygon(corners({-1e6, -1e6, 1}, {2e6, 0, 0}, {0, 2e6, 0}), {0, 0, 1}).area(), pi, 1e-11);
}

// Of 1000 squares and normals of all kinds: two triangles have it together, and it is ∫ cosθ dω by directions that are uniform in
// solid angle, in all at 4.5 standard errors.
TEST(PolygonsSeen, ProjectedSolidAnglesAddUp) {
    Sampler sampler(fixed_seed, 4);
    double difference = 0.0, variance = 0.0;
    int cut = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        sampler.start(i);
        const Frame frame(uniform_sphere(sampler.next2()));
        const Vec3 n = uniform_sphere(sampler.next2());
        const auto number = [&] { return 4.0 * sampler.next() - 2.0; };
        const Vec3 corner = frame.to_world({number(), number(), 0.1 + std::abs(number())}), a = frame.s * std::abs(number()),
                   b = frame.t * std::abs(number());
        const std::array<Vec3, 4> p = corners(corner, a, b);
        const double whole = ProjectedPolygon(p, n).area();
        const double parts =
            ProjectedPolygon(std::array{p[0], p[1], p[3]}, n).area() + ProjectedPolygon(std::array{p[1], p[2], p[3]}, n).area();
        EXPECT_NEAR(whole, parts, 1e-13);
        const SphericalRectangle rectangle(corner, a, b);
        constexpr int samples = 64;
        double mean = 0.0, squares = 0.0;
        for (int j = 0; j < samples; ++j) {
            const double value =
                std::max(glm::dot(n, glm::normalize(rectangle.sample(sampler.next2()))), 0.0) * rectangle.solid_angle();
            mean += value / samples;
            squares += value * value / samples;
        }
        difference += whole - mean;
        variance += (squares - mean * mean) / (samples - 1);
        const auto below = std::count_if(p.begin(), p.end(), [&](const Vec3& q) { return glm::dot(q, n) < 0.0; });
        cut += below > 0 && below < 4;
    }
    EXPECT_GT(cut, 200);
    EXPECT_NEAR(difference, 0.0, 4.5 * std::sqrt(variance));
}

// χ² as above, where the zenith is inside, outside and at a corner, above and across the horizon, and close to a large square. 7
// comparisons.
TEST(PolygonsSeen, DirectionsGoByTheCosine) {
    const Vec3 slanted = glm::normalize(Vec3(1, 0.3, 0.4));
    for (const auto& [corner, a, b, n] : {std::array{Vec3(-0.4, -0.3, 1), Vec3(1.3, 0, 0), Vec3(0, 0.9, 0), Vec3(0, 0, 1)},
                                          std::array{Vec3(0.5, 0.2, 1), Vec3(1.3, 0, 0), Vec3(0, 0.9, 0), Vec3(0, 0, 1)},
                                          std::array{Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)},
                                          std::array{Vec3(0.5, 0.2, -0.4), Vec3(0, 2, 0), Vec3(0, 0, 0.7), Vec3(0, 0, 1)},
                                          std::array{Vec3(-0.5, -0.2, 0.3), Vec3(2, 0, 0), Vec3(0, 2, 0), slanted},
                                          std::array{Vec3(1, -3, 1e-3), Vec3(0, 6, 0), Vec3(0, 0, 2), Vec3(0, 0, 1)},
                                          std::array{Vec3(-1, -1, 1e-3), Vec3(2, 0, 0), Vec3(0, 2, 0), slanted}}) {
        const ProjectedPolygon polygon(corners(corner, a, b), n);
        const Vec3 across = glm::cross(a, b);
        for (const double s : {0.0, 0x1.fffffffffffffp-1})
            for (const double t : {0.0, 0x1.fffffffffffffp-1})
                EXPECT_NEAR(glm::length(polygon.sample({s, t})), 1.0, 1e-12) << s << ' ' << t;
        EXPECT_GT(chi_squared_test(
                      corner, a, b,
                      [&](const Vec2& u) {
                          const Vec3 w = polygon.sample(u);
                          EXPECT_NEAR(glm::length(w), 1.0, 1e-12);
                          return w * (glm::dot(corner, across) / glm::dot(w, across));
                      },
                      [&](const Vec3& c, const Vec3& s, const Vec3& t) {
                          return ProjectedPolygon(corners(c, s, t), n).area() / polygon.area();
                      }),
                  6.8e-6);
    }
}

// Of a lamp that is seen as a whole, a diffuse point knows the light of bounce 1 from one sample: f Le times the projected solid
// angle. The lamp is partly below the horizon.
TEST(PolygonsSeen, UnobstructedLightHasNoNoise) {
    SceneMaker maker;
    maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.01), matte(0.7));
    maker.add(parallelogram({1, -1, -0.5}, {0, 0, 2}, {0, 2, 0}), lamp(3.0));
    const Scene scene = maker.make();
    const double exact = 0.7 * 3.0 / pi * ProjectedPolygon(corners({1, -1, -0.5}, {0, 0, 2}, {0, 2, 0}), {0, 0, 1}).area();
    ASSERT_GT(exact, 0.1);
    for (const LightPlace place : {LightPlace::projected, LightPlace::near_projected}) {
        const Estimates found =
            probe(scene, at(scene, {0, 0, 0}, {0, 0, 1}), Technique::light,
                  {.samples = 256, .bounces = 1, .direct = DirectLightSettings{.direct = DirectLight::light, .place = place}});
        EXPECT_NEAR(found.terms[1].mean.r, exact, 1e-12 * exact);
        EXPECT_LT(found.variance[1].mean.r, 1e-20);
    }
}

// A lamp that stands on the floor, where the variance of points that are uniform by area is infinite: two unit squares with a
// common edge have the form factor 0.2000437766 (Howell, C-14). At 4.5 standard errors, which are small with 16 points a patch.
TEST(PolygonsSeen, PatchesBesideALampReceiveWhatTheyShould) {
    SceneMaker maker;
    maker.add(parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), matte(0.5));
    maker.add(parallelogram({0, 0, 0}, {0, 1, 0}, {0, 0, 1}), lamp(1.0));
    const Scene scene = maker.make();
    const PatchSpace space(scene.geometry, {512, 1.0}, side_directions(scene));
    const ReflectionMatrix<1> R(scene.materials, space);
    constexpr int seeds = 32;
    double mean = 0.0, squares = 0.0;
    for (int seed = 0; seed < seeds; ++seed) {
        const IncidentVector<1> b = arriving_light<1>(scene, R, 16, static_cast<std::uint64_t>(seed));
        double power = 0.0;
        for (const Facet& f : space.facets())
            if (f.cells.size() == 1) power += b.col(f.first)[0] * space.patches().area(f.patch);
        mean += power / seeds;
        squares += power * power / seeds;
    }
    const double standard_error = std::sqrt((squares - mean * mean) / (seeds - 1));
    EXPECT_NEAR(mean, 0.2000437766, 4.5 * standard_error);
    EXPECT_LT(standard_error, 2e-4 * mean);
}

}  // namespace neumann::physics::polygons_seen_test
