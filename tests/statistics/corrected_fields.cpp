// Corrected fields are unbiased whatever the fields are, in every bounce and in the rest; their intervals hold; and the bits do not
// depend on threads.
#include "core/image/pixel_estimate.h"
#include "core/reader/read_scene.h"
#include "core/sampling/sampler.h"
#include "core/sampling/warp.h"
#include "operators/experiments/known/enclosures.h"
#include "operators/paths/corrected/approximation.h"
#include "operators/paths/corrected/shared_points.h"
#include "operators/render/from_paths/corrected_sampler.h"
#include "operators/render/report/least_errors.h"
#include "operators/statistics/student_t.h"
#include "tests/physics/seed.h"
#include "tests/statistics/sampled_moments.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace neumann::corrected_fields_test {

using physics::fixed_seed;

Scene stock_scene(const std::string& name, int resolution) {
    return read_scene(SCENES "/" + name + "/" + name + ".xml", {{"res", std::to_string(resolution)}});
}

SamplingSettings walk_settings(int bounces, std::uint32_t size, std::uint64_t seed, double rest) {
    return {.walk = {.bounces = bounces, .rest_probability = rest}, .seed = seed, .replicate_size = size};
}
SamplingSettings corrected_settings(const Scene& scene, int bounces, std::uint32_t size, std::uint64_t seed, double rest,
                                    std::size_t patches = 300, std::uint32_t rays = 32) {
    SamplingSettings settings = walk_settings(bounces, size, seed, rest);
    settings.method = std::make_shared<const CorrectedPaths>(std::make_shared<const Approximation>(
        scene, ApproximationSettings{.patches = patches, .rays = rays, .bounces = bounces, .seed = seed}));
    return settings;
}

// The means of the picture, of all terms and of the rest, in each channel: 64 replicates or more on both sides, so that 4.5
// standard errors are passed once in 30,000 times, and once in 200 runs of all scenes (about 60 figures). How much it could see is
// printed.
void expect_same_means(const SeriesMoments::Result& walk, const SeriesMoments::Result& corrected, std::size_t quantities,
                       double worst_allowed) {
    double largest = 0.0, worst = 0.0;
    for (std::size_t q = 0; q < quantities; ++q)
        for (std::size_t c = 0; c < 3; ++c) {
            const MeanWithError a = corrected.means_of_term(q).channel[c], b = walk.means_of_term(q).channel[c];
            const double error = std::hypot(a.standard_error, b.standard_error);
            if (error == 0.0) {
                EXPECT_NEAR(a.mean, b.mean, 1e-12 * std::abs(b.mean)) << q;
                continue;
            }
            EXPECT_LE(std::abs(a.mean - b.mean), 4.5 * error)
                << "bounce " << q << ", channel " << c << ": " << a.mean << ", the walk " << b.mean;
            largest = std::max(largest, std::abs(a.mean - b.mean) / error);
            worst = std::max(worst, error / std::max(b.mean, 1e-2 * walk.means_of_term(1).channel[c].mean));
        }
    std::printf("largest |z| %.2f, largest error of a mean %.2f%%\n", largest, 100.0 * worst);
    EXPECT_LE(worst, worst_allowed) << "no power";
}

// The other scenes are in tests/agreement/table.cpp. What glass throws on is found by chance, so that the errors are large.
TEST(CorrectedFieldsSlow, AgreeWithTheWalkInEveryBounceOfTheGlassBall) {
    const Scene scene = stock_scene("glass-ball", 16);
    constexpr int bounces = 5;
    const auto walk = sample(scene, walk_settings(bounces, 32, fixed_seed, 0.0), 512);
    const auto corrected = sample(scene, corrected_settings(scene, bounces, 8, fixed_seed + 1, 0.0), 128);
    expect_same_means(walk, corrected, bounces + 1, 0.35);
}

// Bodies with interpolated normals in a room, one of few faces, whose shading normals are up to 20° off, and one of so many that
// patches are clusters of them. Two sided: near the outlines both sides of the material are met from one side of a face.
TEST(CorrectedFieldsSlow, AgreeWithTheWalkOnSmoothMeshes) {
    const auto smooth = [](int level, const Vec3& center) {
        TriangleMesh mesh = known::icosphere(level);
        mesh.normals = mesh.vertices;
        for (Vec3& vertex : mesh.vertices) vertex = center + 0.6 * vertex;
        return mesh;
    };
    known::SceneMaker maker;
    known::Surface body = known::matte(0.8);
    body.two_sided = true;
    maker.add(known::room({-1.5, -1, -1}, {1.5, 1, 1}), known::matte(0.6));
    maker.add(known::parallelogram({-0.4, -0.4, 0.95}, {0, 0.8, 0}, {0.8, 0, 0}), known::glowing(0.2, 5.0));
    maker.add(smooth(1, {-0.7, 0.1, -0.3}), body);
    maker.add(smooth(4, {0.7, 0.2, -0.2}), body);
    const Frame view(glm::normalize(Vec3(0, 1, -0.4)));
    maker.parts.camera.to_world =
        Mat4(glm::dvec4(view.s, 0.0), glm::dvec4(view.t, 0.0), glm::dvec4(view.n, 0.0), glm::dvec4(0, -0.95, 0.4, 1.0));
    maker.parts.camera.fov = 1.6;
    maker.parts.film = {16, 12, 0, 0, 16, 12};
    const Scene scene = maker.make();
    constexpr int bounces = 4;
    const auto walk = sample(scene, walk_settings(bounces, 32, fixed_seed, 0.5), 512);
    const auto corrected = sample(scene, corrected_settings(scene, bounces, 8, fixed_seed + 1, 0.5), 256);
    expect_same_means(walk, corrected, bounces + 2, 0.02);
}

// Nothing depends on the quality of the fields: from a ray for each of a few patches, 170% off.
TEST(CorrectedFieldsSlow, AreUnbiasedFromBadFields) {
    const Scene scene = stock_scene("mitsuba-cornell", 8);
    const auto walk = sample(scene, walk_settings(3, 32, fixed_seed, 0.5), 256);
    const auto corrected = sample(scene, corrected_settings(scene, 3, 8, fixed_seed + 1, 0.5, 10, 1), 128);
    expect_same_means(walk, corrected, 5, 0.05);
}

// K^i Le = ρ^i in a furnace of any shape, seen from inside; the rest is ρ^5/(1 − ρ). 64 replicates; 6 enclosures of 6 figures and 3
// channels, false alarm of |z| > 4.5 (63 degrees of freedom) 0.5%.
TEST(CorrectedFieldsSlow, EveryFurnaceIsThePowerOfTheAlbedo) {
    const Rgb colour(0.25, 0.5, 0.75);
    for (known::ClosedScene& enclosure : known::enclosures({colour, known::grey(1.0)})) {
        SCOPED_TRACE(enclosure.name);
        enclosure.maker.parts.camera.fov = 2.0;
        enclosure.maker.parts.camera.near_clip = 1e-6;
        enclosure.maker.parts.film = {8, 6, 0, 0, 8, 6};
        const Scene scene = enclosure.maker.make();
        constexpr int bounces = 4;
        const auto found = sample(scene, corrected_settings(scene, bounces, 8, fixed_seed, 1.0, 100), 64);
        for (std::size_t q = 0; q <= bounces + 1; ++q)
            for (std::size_t c = 0; c < 3; ++c) {
                const double rho = colour[static_cast<int>(c)];
                const double exact =
                    q <= bounces ? std::pow(rho, static_cast<double>(q)) : std::pow(rho, bounces + 1.0) / (1.0 - rho);
                const MeanWithError m = found.means_of_term(q).channel[c];
                EXPECT_NEAR(m.mean, exact, 4.5 * m.standard_error + 1e-12) << "bounce " << q;
                EXPECT_LE(m.standard_error, 0.04 * exact) << "no power, bounce " << q;
            }
    }
}

// 95% intervals of pixels and of the picture's mean hold the truth of 100 seeds together, by four replicates as in a short render.
// What a seed's points bring goes into all of its pixels, so that the share of pixels has a standard error of 0.6% over seeds, and
// that of means one of 2.2%. As a render makes them, but for the rest and the health, at which nothing looks.
TEST(CorrectedFieldsSlow, IntervalsHoldTheTruth) {
    const Scene scene = stock_scene("mitsuba-cornell", 16);
    constexpr int bounces = 4;
    constexpr std::uint64_t seeds = 100;
    struct TermOfSeed {
        Image mean, error;
        MeanWithError of_picture;
    };
    std::vector<std::vector<TermOfSeed>> terms(bounces + 1);
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const SamplingSettings settings = corrected_settings(scene, bounces, 8, fixed_seed + seed, 0.0);
        const RenderedSeries series = render_series(scene, settings, {32, std::nullopt, std::nullopt});
        const SeriesMoments::Result found = series.moments.result();
        const LeastErrors least(scene, settings, series, found);
        for (std::size_t q = 1; q <= bounces; ++q) {
            PixelEstimate term = found.term(q);
            term.least_error = least.of_term(q);
            terms[q].push_back({term.mean, term.pixel_errors(), found.means_of_term(q).all});
        }
    }
    const double t = student_t_quantile(0.95, 3.0);
    for (std::size_t q = 1; q <= bounces; ++q) {
        const std::size_t pixels = terms[q][0].mean.pixels.size();
        std::vector<Rgb> truth(pixels, Rgb(0.0));
        double mean = 0.0;
        for (const TermOfSeed& f : terms[q]) {
            for (std::size_t p = 0; p < pixels; ++p) truth[p] += f.mean.pixels[p] / static_cast<double>(seeds);
            mean += f.of_picture.mean / seeds;
        }
        double held = 0.0, means_held = 0.0;
        for (const TermOfSeed& f : terms[q]) {
            for (std::size_t p = 0; p < pixels; ++p)
                for (int c = 0; c < 3; ++c) held += std::abs(f.mean.pixels[p][c] - truth[p][c]) <= t * f.error.pixels[p][c];
            means_held += std::abs(f.of_picture.mean - mean) <= t * f.of_picture.standard_error;
        }
        held /= 3.0 * static_cast<double>(pixels * seeds);
        means_held /= seeds;
        std::printf("bounce %zu: pixels %.3f, means %.3f\n", q, held, means_held);
        EXPECT_GE(held, 0.93) << q;
        // Errors that are not below those of one sample more (one_sample_more.h) let more hold, by so few replicates.
        EXPECT_LE(held, 0.995) << q;
        EXPECT_GE(means_held, 0.95 - 3.0 * 0.022) << q;
    }
}

TEST(CorrectedFields, SameBitsOnAnyThreads) {
    const Scene scene = stock_scene("cornell-box", 12);
    std::vector<std::vector<double>> bits;
    for (const int threads : {1, 2, 7}) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                                static_cast<std::size_t>(threads));
        const PictureSampler sampler(scene, corrected_settings(scene, 3, 4, 7, 0.7));
        Tally tally(sampler.quantities());
        bits.push_back(sampler.run(0, 2, tally)->data);
    }
    for (const auto& other : bits) EXPECT_EQ(std::memcmp(other.data(), bits[0].data(), bits[0].size() * sizeof(double)), 0);
}

// The point that a walk asks, with its weight, is on average the mean over all points, whatever their errors are: clamped, turned
// away, without errors, or a thousand times as large as the others.
TEST(SharedPoints, AskedAreOnAverageAll) {
    Sampler random(3, 0);
    random.start(0);
    constexpr std::size_t n = 64, fields = 3;
    std::vector<SharedPoints::Point> points(n);
    std::vector<Rgb> errors(n * fields);
    for (std::size_t i = 0; i < n; ++i) {
        points[i].y.position = Vec3(random.next2(), random.next());
        points[i].normal = uniform_sphere(random.next2());
        points[i].inverse_density = 0.1 + random.next();
        const double size = i % 7 == 0 ? 0.0 : i % 11 == 0 ? 1e3 : 1.0;
        for (std::size_t k = 0; k < fields; ++k)
            errors[i * fields + k] = size * (Rgb(random.next(), random.next(), random.next()) - 0.5);
    }
    const SharedPoints shared(points, errors);
    const Vec3 x(0.5, 0.5, 0.1), normal(0, 0, 1);
    for (const double clamp : {1e9, 2.0, 0.1}) {
        std::vector<Rgb> mean(fields, Rgb(0.0)), found = mean;
        double asked = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 d = points[i].y.position - x;
            const double a = glm::dot(normal, d), b = -glm::dot(points[i].normal, d), d2 = glm::dot(d, d);
            const double g = a > 0.0 && b > 0.0 ? std::min(a * b * inv_pi / (d2 * d2), clamp) : 0.0;
            for (std::size_t k = 0; k < fields; ++k)
                mean[k] += errors[i * fields + k] * (g * points[i].inverse_density / static_cast<double>(n));
        }
        constexpr int numbers = 1 << 20;
        for (int j = 0; j < numbers; ++j) {
            const SharedPoints::Chosen chosen = shared.choose(x, normal, clamp, (j + 0.5) / numbers);
            for (std::size_t k = 0; k < fields; ++k) found[k] += shared.carried_by(chosen.point)[k] * (chosen.weight / numbers);
            asked += chosen.weight > 0.0;
        }
        EXPECT_GT(asked, 0.5 * numbers);
        // Of each place, the midpoints of 2^18 intervals lie on the wrong side of at most 16 boundaries.
        for (std::size_t k = 0; k < fields; ++k)
            EXPECT_LT(max_component(glm::abs(found[k] - mean[k])), 1e-4 * max_component(glm::abs(mean[k])) + 1e-3) << clamp;
    }
}

}  // namespace neumann::corrected_fields_test
