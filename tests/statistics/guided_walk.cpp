// Walks whose directions are drawn by tables of what a surface sees.
#include "core/reader/read_scene.h"
#include "operators/experiments/known/enclosures.h"
#include "operators/fields/matrix/scene_patches.h"
#include "operators/paths/walk/guided_continuation.h"
#include "operators/render/from_paths/guided_paths.h"
#include "operators/statistics/picture_statistics.h"
#include "tests/physics/material_laws.h"
#include "tests/physics/pictures.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cstring>

namespace neumann::physics::guided_walk_test {

Scene cornell_box(int resolution) {
    return read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", std::to_string(resolution)}});
}

std::shared_ptr<const Guide> guide(const Scene& scene, std::size_t patches = 500) {
    return std::make_shared<const Guide>(scene, GuideSettings{.patches = patches, .rays = 256, .seed = fixed_seed});
}

CellDistribution::Weights lopsided_weights() {
    CellDistribution::Weights weights;
    for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] = 0.2 + 1.6 * static_cast<double>(i * 29 % weights.size()) / (CellDistribution::cells - 1.0);
    return weights;
}

// A point of the cornell box's floor beside its boxes, and where wo is.
SurfaceSide on_the_floor(const Scene& scene) {
    SurfacePoint p;
    EXPECT_TRUE(scene.geometry.first_hit(Vec3(440.0, 100.0, 60.0), Vec3(0, -1, 0), 1e9, p));
    return scene.materials.side(p, {0, 1, 0});
}

// 2^16ths, so each density is right to k/2^17 in the row and in the cell; and their mean is 1.
TEST(CellDistribution, HasTheDensityOfItsWeights) {
    const CellDistribution::Weights weights = lopsided_weights();
    const CellDistribution cells(weights);
    const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) / CellDistribution::cells;
    double sum = 0.0;
    for (std::uint32_t cell = 0; cell < CellDistribution::cells; ++cell) {
        EXPECT_NEAR(cells.density(cell), weights[cell] / mean, 5e-4);
        sum += cells.density(cell);
    }
    EXPECT_NEAR(sum, CellDistribution::cells, 1e-12);
}

TEST(CellDistribution, AUniformOneChangesNothing) {
    const CellDistribution cells;
    for (const double u : {0.0, 0.1, 0.125, 0.5, 0.7, 1.0 - 0x1p-33}) {
        const auto place = cells.sample({u, 1.0 - 0x1p-33 - u});
        EXPECT_EQ(place.inverse_density, 1.0);
        EXPECT_NEAR(place.u.x, u, 1e-15);
        EXPECT_NEAR(place.u.y, 1.0 - u, 1e-9);
    }
}

// χ² of 2^18 samples in 32 × 32 squares, four to a cell. 1 comparison, false alarm 10^-5.
TEST(CellDistribution, SamplesFollowTheDensity) {
    const CellDistribution cells(lopsided_weights());
    constexpr std::uint32_t n = 2 * CellDistribution::k;
    constexpr int count = 1 << 18;
    std::vector<double> found(n * n);
    Sampler sampler(fixed_seed, 0);
    for (std::uint64_t i = 0; i < count; ++i) {
        sampler.start(i);
        const auto place = cells.sample(sampler.next2());
        ASSERT_TRUE(place.u.x >= 0.0 && place.u.x < 1.0 && place.u.y >= 0.0 && place.u.y < 1.0);
        EXPECT_NEAR(cells.density(CellDistribution::grid.cell_of_square(place.u)) * place.inverse_density, 1.0, 1e-12);
        found[DirectionCells{n}.cell_of_square(place.u)] += 1.0;
    }
    double chi2 = 0.0;
    for (std::uint32_t i = 0; i < n * n; ++i) {
        const std::uint32_t cell = i / n / 2 * CellDistribution::k + i % n / 2;
        const double expected = cells.density(cell) * count / (n * n);
        chi2 += (found[i] - expected) * (found[i] - expected) / expected;
    }
    EXPECT_GT(cdf(complement(boost::math::chi_squared(n * n - 1), chi2)), 1e-5);
}

// What the weights of directions in a cell add up to is ρ times the cell's share of projected solid angle, 1/16 each, whatever the
// density: in the frame of the table, and in frames that texture coordinates turn, and of the other handedness. Replicates of 256
// directions make z; 16 cells in 3 frames, false alarm 3e-4 of |z| > 4.5.
TEST(GuidedDirections, WeighWhatTheyMissInAnyFrame) {
    const Scene scene = cornell_box(8);
    const GuidedContinuation guided(guide(scene));
    const Vec3 wo = glm::normalize(Vec3(0.3, -0.2, 0.5));
    SurfaceSide side = on_the_floor(scene);
    const Frame flat = side.p.frame;
    const Vec3 s = std::cos(1.0) * flat.s + std::sin(1.0) * flat.t, t = glm::cross(flat.n, s);
    for (const Frame& frame : {flat, Frame(s, t, flat.n), Frame(s, -t, flat.n)}) {
        side.p.frame = frame;
        const auto vertex = guided.at(side, guided.vertex_data(side.p, side.p.frame.n, 3));
        constexpr std::uint32_t n = 4, replicates = 4096, size = 256;
        std::vector<double> sum(n * n), squares(n * n);
        Sampler sampler(fixed_seed, 1);
        double least = 1.0, most = 1.0;
        for (std::uint64_t r = 0; r < replicates; ++r) {
            std::vector<double> found(n * n);
            for (std::uint64_t i = 0; i < size; ++i) {
                sampler.start(r * size + i);
                const BsdfSample sampled = vertex.sample(side, wo, sampler);
                EXPECT_NEAR(glm::length(sampled.wi), 1.0, 1e-12);
                EXPECT_EQ(vertex.pdf(side, wo, sampled.wi, {}), sampled.pdf);
                const double exact = eval(*side.bsdf, side.p, wo, sampled.wi).r * pi, weight = sampled.weight.r / exact;
                found[DirectionCells{n}.cell(sampled.wi)] += weight / size;
                least = std::min(least, 1.0 / weight);
                most = std::max(most, 1.0 / weight);
            }
            for (std::uint32_t i = 0; i < n * n; ++i) {
                sum[i] += found[i];
                squares[i] += found[i] * found[i];
            }
        }
        EXPECT_LT(least, 0.6) << "there is something to see";
        EXPECT_GT(most, 1.5);
        for (std::uint32_t i = 0; i < n * n; ++i) {
            const double mean = sum[i] / replicates, variance = squares[i] / replicates - mean * mean;
            EXPECT_NEAR(mean, 1.0 / (n * n), 4.5 * std::sqrt(variance / (replicates - 1.0))) << i;
            EXPECT_LT(std::sqrt(variance / replicates), 0.01 * mean) << "no power";
        }
    }
}

// A cell of the raster has a sixteenth of a patch's area on average; of those that the edge of a patch goes through, 44% where
// patches are alike, at most half is taken for the neighbour, and more where patches are narrow. Never is it another surface.
TEST(FacetRaster, FindsTheFacetOrANeighbour) {
    const Scene scene = cornell_box(8);
    const PatchSpace space = scene_patches(scene, {.patches = 2000});
    const Patches& patches = space.patches();
    const FacetRaster raster(space);
    const AreaSampler surfaces(scene.geometry);
    Sampler sampler(fixed_seed, 2);
    constexpr int count = 20000;
    int same = 0;
    for (int i = 0; i < count; ++i) {
        sampler.start(static_cast<std::uint64_t>(i));
        const double choice = sampler.next();
        const SurfacePoint p = surfaces.sample(choice, sampler.next2());
        const std::uint32_t facet = raster.facet(p, true), exact = space.facet(patches.locate(p), true);
        same += facet == exact;
        if (exact == space.facets().size()) continue;
        ASSERT_LT(facet, space.facets().size());
        EXPECT_EQ(patches.chart_number(space.facets()[facet].patch), patches.chart_of(p));
    }
    std::printf("%.1f%% are the facet itself\n", 100.0 * same / count);
    EXPECT_GT(same, 0.7 * count);
}

// There the material alone draws the direction.
TEST(GuidedDirections, ThereIsNoTableWhereNoFurtherBounceIsWantedNorForMetals) {
    const Scene box = cornell_box(8);
    const SurfaceSide floor = on_the_floor(box);
    const GuidedContinuation guided(guide(box));
    const Vec3 wo(0.0, 0.0, 1.0);
    const auto weight = [&](const GuidedContinuation& continuation, const SurfaceSide& side, int wanted) {
        Sampler sampler(fixed_seed, 1);
        sampler.start(0);
        return continuation.at(side, continuation.vertex_data(side.p, side.p.frame.n, wanted)).sample(side, wo, sampler).weight;
    };
    const auto weight_of_material = [&](const SurfaceSide& side) {
        Sampler sampler(fixed_seed, 1);
        sampler.start(0);
        return MaterialContinuation().sample(side, wo, sampler).weight;
    };
    EXPECT_EQ(weight(guided, floor, 0), weight_of_material(floor));
    EXPECT_NE(weight(guided, floor, 1), weight_of_material(floor));

    const Scene room = read_scene(SCENES "/metal-room/metal-room.xml", {{"res", "8"}});
    const GuidedContinuation in_room(guide(room));
    int metals = 0;
    for (std::uint32_t shape = 0; shape < room.geometry.shapes().size(); ++shape) {
        const SurfacePoint p = room.geometry.point(shape, 0, {0.3, 0.4});
        const SurfaceSide side = room.materials.side(p, p.normal);
        if (!side.bsdf || std::holds_alternative<Diffuse>(*side.bsdf)) continue;
        ++metals;
        EXPECT_EQ(weight(in_room, side, 2), weight_of_material(side));
    }
    EXPECT_GE(metals, 2);
}

// All directions are alike there, and the tables exactly uniform.
TEST(GuidedWalk, EveryPixelOfAFurnaceIsThePowerOfTheAlbedo) {
    const Rgb colour(0.25, 0.5, 0.75);
    for (ClosedScene& enclosure : enclosures({colour, grey(1.0)})) {
        SCOPED_TRACE(enclosure.name);
        enclosure.maker.parts.camera.fov = 2.0;
        enclosure.maker.parts.camera.near_clip = 1e-6;
        enclosure.maker.parts.film = {8, 6, 0, 0, 8, 6};
        const Scene scene = enclosure.maker.make();
        const Pictures pictures = render(scene,
                                         {.method = std::make_shared<const GuidedPaths>(guide(scene, 100)),
                                          .walk = {.bounces = 10, .direct = {DirectLight::bsdf}, .rest_probability = 0.0},
                                          .seed = fixed_seed},
                                         4);
        for (int i = 0; i <= 10; ++i) {
            const Estimate term = pictures.result.term(static_cast<std::size_t>(i));
            double error = 0.0, spread = 0.0;
            for (const Rgb& x : term.mean.pixels) error = std::max(error, max_component(glm::abs(x - power_of(colour, i))));
            for (const Rgb& x : term.standard_error.pixels) spread = std::max(spread, max_component(x));
            EXPECT_LE(error, 8.0 * i * std::numeric_limits<double>::epsilon()) << "K^" << i << " Le";
            EXPECT_EQ(spread, 0.0) << "K^" << i << " Le";
        }
    }
}

TEST(GuidedWalk, SameBitsOnAnyThreads) {
    const Scene scene = cornell_box(12);
    std::vector<SeriesMoments::Result> results;
    for (const std::size_t threads : {1, 2, 7}) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        results.push_back(
            render(scene, {.method = std::make_shared<const GuidedPaths>(guide(scene)), .walk = {.bounces = 4}, .seed = fixed_seed},
                   4)
                .result);
    }
    for (std::size_t i = 0; i <= 5; ++i)
        for (const std::size_t other : {1, 2}) {
            const Image a = results[0].term(i).mean, b = results[other].term(i).mean;
            EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Rgb)), 0);
        }
}

// What the tables are for: of as many samples, at most 0.6 of the plain walk's variance in bounces 2 to 6 (it is 0.35 to 0.5). The
// ratio of two such sums has an error of about 3%.
TEST(GuidedWalkSlow, HasLessVarianceThanThePlainWalk) {
    const Scene scene = cornell_box(48);
    const auto rendered = [&](const std::shared_ptr<const PathMethod>& method) {
        return render(scene, {.method = method, .walk = {.bounces = 7, .rest_probability = 0.0}, .seed = fixed_seed}, 32).result;
    };
    const auto plain = rendered(plain_walks()), guided = rendered(std::make_shared<const GuidedPaths>(guide(scene, 2000)));
    for (std::size_t i = 2; i <= 6; ++i)
        EXPECT_LT(std::pow(relative_standard_error(guided.term(i)) / relative_standard_error(plain.term(i)), 2), 0.6) << i;
}

}  // namespace neumann::physics::guided_walk_test
