// Irradiance caches where the series is known in closed form: light is the same everywhere on a surface, so that interpolation is
// right on average and all that is left is noise. And what is the same whatever the machine does: the bits.
#include "core/base/error.h"
#include "core/reader/read_scene.h"
#include "operators/experiments/known/enclosures.h"
#include "operators/paths/cache/record_places.h"
#include "operators/render/from_paths/cache_sampler.h"
#include "operators/render/methods/method_options.h"
#include "tests/physics/picture_blocks.h"
#include "tests/physics/seed.h"
#include "tests/physics/today.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>

namespace neumann::cache_closed_scenes_test {

using physics::Blocks;
using physics::fixed_seed;
using physics::settings_of;

constexpr std::size_t bounces = 4;
constexpr double largest_error = 0.004;

SamplingSettings cache_settings(const Scene& scene, const char* rays) {
    return settings_of(scene, make_method({"cache", {{"directions", rays}}}), bounces, fixed_seed, 0.5);
}

// The white furnace, K^i Le = ρ^i and Σ_{i>N} ρ^i = ρ^(N+1)/(1 − ρ): 8 scenes, bounces 2 … 4 and the rest, 3 channels. 96
// comparisons at |z| ≤ 4.5, a false alarm in 1500 runs. A third of the scenes a day.
TEST(CacheClosedScenesSlow, Furnace) {
    const Rgb albedo(0.25, 0.5, 0.75);
    std::size_t number = 0;
    for (known::ClosedScene& enclosure : known::enclosures({albedo, Rgb(1.0)})) {
        if (!physics::is_of_today(number++)) continue;
        SCOPED_TRACE(enclosure.name);
        enclosure.maker.parts.camera.fov = 2.0;
        enclosure.maker.parts.camera.near_clip = 1e-6;
        enclosure.maker.parts.film = {8, 8, 0, 0, 8, 8};
        const Scene scene = enclosure.maker.make();
        const Blocks cache(scene, cache_settings(scene, "64"), 8, 64);
        for (std::size_t i = 2; i <= bounces + 1; ++i)
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const double rho = albedo[static_cast<int>(channel)],
                             exact = std::pow(rho, static_cast<double>(i)) / (i > bounces ? 1.0 - rho : 1.0);
                const auto found = cache.at(0, i, channel, cache.replicates());
                EXPECT_LE(found.error, largest_error * exact);
                EXPECT_LE(std::abs(found.mean - exact),
                          4.5 * found.error + 4e-6 * exact)  // floats, and the rest ends at changes of 1e-6
                    << "bounce " << i << ", channel " << channel << ": " << found.mean << " ± " << found.error << ", exactly "
                    << exact;
            }
    }
}

// A sphere closed by a disc that shines, two surfaces with K = [0, ρd; ρs (1 − f), ρs f], f = 3/4
// (operators/experiments/known/two_patches.cpp): 16 blocks at most, bounces 2 … 4, one channel of three that are alike. 48
// comparisons at |z| ≤ 4.5, a false alarm in 3000 runs.
TEST(CacheClosedScenesSlow, SphereClosedByADisc) {
    const Scene scene = read_scene(SCENES "/sphere-segment/sphere-segment.xml", {{"res", "32"}});
    const Blocks cache(scene, cache_settings(scene, "128"), 8, 64);
    std::vector<double> disc{1.0}, sphere{0.0};
    for (std::size_t i = 1; i <= bounces; ++i) {
        disc.push_back(0.7 * sphere[i - 1]);
        sphere.push_back(0.5 * (0.25 * disc[i - 1] + 0.75 * sphere[i - 1]));
    }
    int on_disc = 0, on_sphere = 0;
    for (std::size_t b = 0; b < cache.blocks(); ++b) {
        const auto emitted = cache.at(b, 0, 0, cache.replicates());
        if (emitted.error > 0.0) continue;  // both are seen
        ++(emitted.mean > 0.5 ? on_disc : on_sphere);
        for (std::size_t i = 2; i <= bounces; ++i) {
            const double exact = (emitted.mean > 0.5 ? disc : sphere)[i];
            const auto found = cache.at(b, i, 0, cache.replicates());
            EXPECT_LE(found.error, largest_error * exact);
            EXPECT_LE(std::abs(found.mean - exact), 4.5 * found.error + 1e-6 * exact)
                << "bounce " << i << ", block " << b << ": " << found.mean << " ± " << found.error << ", exactly " << exact;
        }
    }
    EXPECT_GE(on_disc, 2);
    EXPECT_GE(on_sphere, 4);
}

TEST(CacheClosedScenes, HaveTheSameBitsOnAnyNumberOfThreads) {
    const Scene scene = read_scene(SCENES "/glossy-floor/glossy-floor.xml", {{"res", "16"}});
    const auto bits = [&](std::size_t threads) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        const SamplingSettings settings = cache_settings(scene, "32");
        Tally tally(settings.quantities());
        std::vector<double> all = PictureSampler(scene, settings).run(1, 1, tally)->data;
        for (const Record& record : as<CachePaths>(settings.method)->records().records()) {
            all.push_back(record.radius);
            for (int i = 0; i < 3; ++i) all.push_back(record.x.position[i]);
        }
        return all;
    };
    const std::vector<double> one = bits(1);
    EXPECT_GT(one.size(), 1000u);
    EXPECT_EQ(bits(2), one);
    EXPECT_EQ(bits(7), one);
}

// Every vertex near which a record stands is read with weights that the record itself has at its place; and places do not depend on
// the number of bounces.
TEST(CacheClosedScenes, RecordsCoverWhatIsSeen) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "32"}});
    const auto places = [&](Spacing spacing, double accuracy) {
        return RecordPlaces(scene, {spacing, accuracy, 64}, SamplerKind::sobol, fixed_seed, 1e9);
    };
    std::vector<RecordPlaces::NearRecord> near;
    for (const Spacing spacing : {Spacing::hessian, Spacing::split_sphere}) {
        const RecordPlaces few = places(spacing, 2.0 * default_accuracy(spacing)),
                           usual = places(spacing, default_accuracy(spacing));
        EXPECT_LT(few.records().size(), usual.records().size());
        EXPECT_GT(few.seen(), 20u);
        EXPECT_LT(usual.seen(), usual.records().size());  // some of what records see is out of the picture
        for (std::size_t i = 0; i < usual.records().size(); ++i) {
            const Record& record = usual.records()[i];
            usual.find(record.x.position, record.frame.n, false, 1.0, near);
            const auto self = std::ranges::find_if(near, [&](const auto& of) { return of.record == i; });
            ASSERT_NE(self, near.end());
            EXPECT_LE(self->error, 1e-6f);
            // None stands where another one of its kind, placed before, already said enough.
            for (const auto& of : near) {
                if (of.record < i && usual.records()[of.record].is_seen >= record.is_seen) {
                    EXPECT_GE(of.error, 0.8f - 1e-6f);
                }
            }
        }
    }
}

TEST(CacheClosedScenes, RefuseWhatTheyCannotDo) {
    const auto refusal = [](const Scene& scene, const CacheSettings& settings, double memory) -> std::string {
        try {
            RecordPlaces(scene, settings, SamplerKind::sobol, 0, memory);
        } catch (const InputError& e) {
            return e.what();
        }
        return "";
    };
    const CacheSettings usual{Spacing::hessian, 0.05, 64};
    const Scene box = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "16"}});
    EXPECT_EQ(refusal(box, usual, 1e9), "");
    const std::string much = refusal(box, usual, 1e5);  // at 96 bytes a ray
    EXPECT_EQ(much,
              fmt::format("accuracy 0.05: the rays of {} records, and more are needed, take 0.0 GiB, and 0.0 may be taken; take a "
                          "larger number, or fewer directions",
                          static_cast<int>(1e5 / (96.0 * static_cast<double>(HemisphereCells(64).size()))) + 1));
    known::SceneMaker mirrors;
    mirrors.add(Sphere{{0, 0, 0}, 1.0, true}, known::made_of(Conductor(), Rgb(1.0)));
    EXPECT_EQ(refusal(mirrors.make(), usual, 1e9),
              "cache keeps records on diffuse surfaces, and paths from the camera meet none; take walk");
}

}  // namespace neumann::cache_closed_scenes_test
