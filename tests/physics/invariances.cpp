// What may not depend on the choice of units or of the origin. The same random numbers make the same walks, so whole pictures are
// compared, pixel by pixel.
#include "operators/render/methods/render.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::physics::invariances_test {

constexpr int width = 48, height = 36, bounces = 8;

struct Units {
    double length = 1.0;
    Vec3 origin{0.0};
    double radiance = 1.0;
};

// A room with two boxes in it, coloured walls and a lamp; coordinates that have no short binary form.
Scene furnished_room(const Units& units) {
    SceneMaker maker;
    const auto place = [&](TriangleMesh mesh) {
        for (Vec3& v : mesh.vertices) v = v * units.length + units.origin;
        return mesh;
    };
    const auto coloured = [](const Rgb& rho) { return Surface{rho, std::nullopt}; };
    const auto faces = room({-1.1, -1.0, -0.9}, {1.1, 1.3, 0.9});
    for (std::size_t i = 0; i < 6; ++i)
        maker.add(place(faces[i]), coloured(i == left    ? Rgb(0.63, 0.07, 0.05)
                                            : i == right ? Rgb(0.14, 0.45, 0.09)
                                                         : Rgb(0.73, 0.71, 0.68)));
    const double c = std::cos(0.3), s = std::sin(0.3);
    TriangleMesh turned = box({-0.3, -0.3, 0.0}, {0.3, 0.3, 1.1});
    for (Vec3& v : turned.vertices) v = Vec3(c * v.x - s * v.y - 0.4, s * v.x + c * v.y + 0.7, v.z - 0.87);
    maker.add(place(turned), coloured(Rgb(0.6)));
    maker.add(place(box({0.2, -0.1, -0.7}, {0.7, 0.4, -0.3})), coloured(Rgb(0.8, 0.5, 0.2)));
    maker.add(place(parallelogram({-0.3, 0.1, 0.83}, {0, 0.5, 0}, {0.6, 0, 0})),
              {grey(0.3), Rgb(17.0, 12.0, 4.0) * units.radiance});

    SensorOptions& camera = maker.parts.camera;
    // Looks along +y, z is up.
    camera.to_world = Mat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 0, 1, 0), glm::dvec4(0, 1, 0, 0),
                           glm::dvec4(Vec3(0.05, -0.93, 0.07) * units.length + units.origin, 1.0));
    camera.fov = 1.4;
    camera.near_clip *= units.length;
    camera.far_clip *= units.length;
    maker.parts.film = {width, height, 0, 0, width, height, BoxFilter()};
    return maker.make();
}

BounceSeries pictures(const Scene& scene) {
    return render(scene, method::Walk(), {.bounces = bounces, .samples = 32, .seed = fixed_seed});
}

// Pixels × channels of all terms and the rest in which `same` does not hold for the values and their standard errors.
template <class Same>
int count_different(const BounceSeries& a, const BounceSeries& b, Same same) {
    int different = 0;
    for (int q = 0; q <= bounces + 1; ++q) {
        const auto picture = [q](const BounceSeries& s) { return q <= bounces ? s.term(static_cast<std::size_t>(q)) : *s.rest; };
        const PixelEstimate x = picture(a), y = picture(b);
        for (std::size_t i = 0; i < x.mean.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c)
                different += !same(x.mean.pixels[i][c], y.mean.pixels[i][c]) ||
                             !same(x.standard_error.pixels[i][c], y.standard_error.pixels[i][c]);
    }
    return different;
}

TEST(Invariance, RadianceTimesAPowerOfTwoGivesTheSameBits) {
    const BounceSeries one = pictures(furnished_room({}));
    for (const int k : {-20, 10, 60}) {
        const BounceSeries other = pictures(furnished_room({.radiance = std::ldexp(1.0, k)}));
        EXPECT_EQ(count_different(one, other, [k](double x, double y) { return std::ldexp(x, k) == y; }), 0) << "2^" << k;
    }
}

// Values are sums of 32 products of positive numbers with less than 100 factors each; standard errors are differences of such
// values.
TEST(Invariance, RadianceFromVerySmallToVeryLarge) {
    const BounceSeries one = pictures(furnished_room({}));
    for (const double factor : {1e-30, 3.0, 1e30}) {
        const BounceSeries other = pictures(furnished_room({.radiance = factor}));
        for (int i = 0; i <= bounces; ++i) {
            const Estimate x = one.term(static_cast<std::size_t>(i)), y = other.term(static_cast<std::size_t>(i));
            double largest = 0.0, largest_of_error = 0.0;
            for (std::size_t p = 0; p < x.mean.pixels.size(); ++p)
                for (int c = 0; c < 3; ++c) {
                    const double mean = x.mean.pixels[p][c];
                    ASSERT_TRUE(std::isfinite(y.mean.pixels[p][c]) && std::isfinite(y.standard_error.pixels[p][c]));
                    if (mean == 0.0) {
                        EXPECT_EQ(y.mean.pixels[p][c], 0.0);
                        continue;
                    }
                    largest = std::max(largest, std::abs(y.mean.pixels[p][c] / (mean * factor) - 1.0));
                    largest_of_error = std::max(
                        largest_of_error, std::abs(y.standard_error.pixels[p][c] / factor - x.standard_error.pixels[p][c]) / mean);
                }
            EXPECT_LE(largest, 132 * std::numeric_limits<double>::epsilon()) << "K^" << i << " Le, factor " << factor;
            EXPECT_LE(largest_of_error, 132 * std::numeric_limits<double>::epsilon()) << "K^" << i << " Le, factor " << factor;
        }
    }
}

TEST(Invariance, LengthsTimesAPowerOfTwoGiveTheSameBits) {
    const BounceSeries one = pictures(furnished_room({}));
    for (const int k : {-20, 1, 20}) {
        const BounceSeries other = pictures(furnished_room({.length = std::ldexp(1.0, k)}));
        EXPECT_EQ(count_different(one, other, [](double x, double y) { return x == y; }), 0) << "2^" << k;
        EXPECT_EQ(one.rays, other.rays);
    }
}

// Pixels in which camera rays at the corners, the middle and the sides meet different surfaces or faces.
std::vector<bool> silhouettes(const Scene& scene) {
    std::vector<bool> found;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            SurfacePoint first{}, hit{};
            bool mixed = false;
            for (int i = 0; i <= 8; ++i)
                for (int j = 0; j <= 8; ++j) {
                    const CameraRay ray = scene.camera.ray({x + i / 8.0, y + j / 8.0});
                    EXPECT_TRUE(scene.geometry.first_hit(ray.origin, ray.direction, ray.length, hit));
                    if (i + j == 0) first = hit;
                    mixed |= hit.shape != first.shape || glm::dot(hit.normal, first.normal) < 0.999;
                }
            found.push_back(mixed);
        }
    return found;
}

// Elsewhere coordinates are rounded differently, by 1e-7 of the room's size in Embree's floats. A pixel outside silhouettes
// changes by more than 1e-5 only where one of its walks, deeper in the room, meets an edge within that distance and goes on from
// the other side. A ray does so with a probability of about 1e-7 times the edges' length over the room's size, some 20: with 1728
// pixels × 32 samples × 20 rays that is at most 3 walks (a Poisson number, above 12 with a probability of 2e-5), each of which
// shows in the pictures of all later bounces of its pixel.
TEST(InvarianceSlow, OtherUnitsAndAnotherOriginChangeNothingButRounding) {
    const Scene scene = furnished_room({});
    const std::vector<bool> silhouette = silhouettes(scene);
    const BounceSeries one = pictures(scene);
    for (const Units& units : {Units{.length = 1e-6}, Units{.length = 1e6}, Units{.length = 0.7}, Units{.origin = {1e5, -2e5, 3e4}},
                               Units{.length = 1e-6, .origin = {0.1, -0.2, 0.03}}}) {
        const BounceSeries other = pictures(furnished_room(units));
        int exceptions = 0;
        for (std::size_t p = 0; p < silhouette.size(); ++p) {
            if (silhouette[p]) continue;
            bool differs = false;
            for (int i = 0; i <= bounces; ++i) {
                const Rgb x = one.term(static_cast<std::size_t>(i)).mean.pixels[p],
                          y = other.term(static_cast<std::size_t>(i)).mean.pixels[p];
                for (int c = 0; c < 3; ++c) differs |= std::abs(x[c] - y[c]) > 1e-5 * std::abs(x[c]);
            }
            exceptions += differs;
        }
        EXPECT_LE(exceptions, 12) << "lengths times " << units.length << ", origin at " << units.origin.x;
    }
}

// Channels do not know of each other: in a cube whose ceiling emits, the same walks, ρ_c^i for each.
TEST(Invariance, EveryChannelHasItsOwnPowers) {
    const Rgb rho(0.9, 0.5, 0.25);
    SceneMaker maker;
    const auto faces = room({0, 0, 0}, {1, 1, 1});
    for (std::size_t i = 0; i < 6; ++i)
        maker.add(faces[i], {rho, i == ceiling ? std::optional<AreaLight>(grey(1.0)) : std::nullopt});
    const Scene scene = maker.make();
    const Estimates found = probe(scene, at(scene, {0, 0.5, 0.5}, {1, 0, 0}), Technique::mis, {.samples = 64, .bounces = 10});
    for (int i = 1; i <= 10; ++i) {
        const Rgb& mean = found.terms[static_cast<std::size_t>(i)].mean;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(mean[c] / power_of(rho, i)[c], mean.r / power_of(rho, i).r, 1e-14 * i) << "K^" << i << " Le";
    }
}

}  // namespace neumann::physics::invariances_test
