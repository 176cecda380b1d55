// A sample that is traced again has the bits of the render: the means of pixels, put together from replayed samples alone, are
// those of the pictures.
#include "operators/render/report/replay.h"
#include "core/reader/read_scene.h"
#include "operators/paths/cache/record_places.h"
#include "operators/paths/photons/photon_pilot.h"
#include "operators/render/from_paths/cache_sampler.h"
#include "operators/render/from_paths/photon_sampler.h"
#include "operators/render/methods/method_options.h"
#include "operators/render/methods/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace neumann::replay_test {

constexpr std::uint32_t size = 4;
constexpr int bounces = 3;

struct Case {
    const char* name;
    const char* method;  // as read_method() reads it
    friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
};

bool same_bits(const Rgb& a, const Rgb& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

class ReplayEvery : public testing::TestWithParam<Case> {
protected:
    // 49 pixels: the last of the 64 paths that advance together are fewer.
    Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "7"}});
    SamplingSettings settings() const {
        const Method method = read_method(GetParam().method);
        SamplingSettings s = sampling_settings(method, scene, {}, 5);
        s.walk.bounces = bounces;
        s.walk.rest_probability = 0.7;
        s.replicate_size = size;
        Prepared prepared(5);
        set_up(method, scene, bounces, 1e9, s, prepared);
        return s;
    }
};

TEST_P(ReplayEvery, PixelsAreTheMeansOfReplayedSamples) {
    const PictureSampler sampler(scene, settings());
    const std::size_t Q = sampler.quantities();
    constexpr std::uint64_t replicate = 1;
    Tally tally(Q);
    const MomentsNode node = *sampler.run(replicate, 1, tally);
    const std::size_t pixels = 49;
    std::vector<Rgb> own(pixels * Q, Rgb(0.0)), splatted = own;
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel)
        for (std::uint32_t i = 0; i < size; ++i) {
            const Replay found = replay(sampler, {pixel, replicate * size + i});
            for (std::size_t q = 0; q < found.terms.size(); ++q) own[pixel * Q + q] += found.terms[q];
            for (const ReplayedStep& step : found.steps)
                for (const auto& f : step.found) {
                    if (!f.pixel) continue;
                    const auto x = static_cast<std::size_t>(f.pixel->x), y = static_cast<std::size_t>(f.pixel->y);
                    splatted[(7 * y + x) * Q + f.quantity] += f.value;
                }
        }
    std::size_t lit = 0;
    for (std::size_t k = 0; k < own.size(); ++k) {
        const std::size_t pixel = k / Q, q = k % Q;
        if (q >= sampler.settings().pictures()) continue;  // differences between two radii
        const double* mean = node.data.data() + k * PixelMoments::doubles_per_quantity;
        const Rgb rendered(mean[0], mean[1], mean[2]), replayed = (own[k] + splatted[k]) * (1.0 / size);
        // What comes from the lights is added to the rest in another order here, and what chains leave to all bounces.
        if (sampler.settings().method->has_chains() && q > 0)
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(rendered[c], replayed[c], 1e-12 * std::abs(rendered[c]));
        else if (sampler.settings().method->splats() && q == Q - 1)
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(rendered[c], replayed[c], 1e-14 * std::abs(rendered[c]));
        else
            EXPECT_TRUE(same_bits(rendered, replayed))
                << "pixel " << pixel << ", quantity " << q << ": " << rendered.r << ", " << replayed.r;
        lit += !is_black(rendered);
    }
    EXPECT_GT(lit, pixels / 2) << "nothing but zeros were compared";
}

// What the steps bring adds up to the terms.
TEST_P(ReplayEvery, StepsBringWhatTheSampleIsWorth) {
    const PictureSampler sampler(scene, settings());
    for (std::uint32_t pixel = 0; pixel < 49; pixel += 6) {
        const Replay found = replay(sampler, {pixel, 2});
        if (sampler.settings().method->starts_at_camera()) {
            EXPECT_FALSE(found.steps.empty());
        }
        std::vector<Rgb> sum(sampler.quantities(), Rgb(0.0));
        for (const ReplayedStep& step : found.steps)
            for (const auto& f : step.found)
                if (!f.pixel) sum[f.quantity] += f.value;
        for (std::size_t q = 0; q < found.terms.size(); ++q)
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[q][c], found.terms[q][c], 1e-13 * std::abs(found.terms[q][c])) << q;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Methods, ReplayEvery,
    testing::Values(Case{"Walk", "walk"}, Case{"WalkIndependent", "walk:sampler=independent"}, Case{"WalkSplit", "walk:split=3,2"},
                    Case{"WalkTree", "walk:tree=3"}, Case{"WalkReuse", "walk:reuse=true"},
                    Case{"Guided", "guided:patches=100:directions=1024"}, Case{"Photon", "photon:photons=1000"},
                    Case{"Metropolis", "metropolis:chain=3"}, Case{"Surface", "surface"}, Case{"Classic", "classic"},
                    Case{"Light", "light"}, Case{"Shooting", "shooting"}, Case{"WalkUniform", "walk:indirect=uniform"},
                    Case{"WalkEqualTree", "walk:tree=equal-2"}, Case{"LightIndependent", "light:sampler=independent"},
                    Case{"Bidirectional", "bidirectional"}, Case{"BidirectionalSplit", "bidirectional:split=3,2"}),
    [](const auto& info) { return std::string(info.param.name); });
INSTANTIATE_TEST_SUITE_P(MethodsSlow, ReplayEvery,
                         testing::Values(Case{"Corrected", "corrected:patches=100:directions=16"},
                                         Case{"Cache", "cache:accuracy=1:directions=16"}),
                         [](const auto& info) { return std::string(info.param.name); });

// After the walk comes the path of the photon that brings most, joined ray by ray, and it ends where the walk read the map.
TEST(Replay, APhotonIsFollowedToItsLight) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "16"}});
    const auto pilot = std::make_shared<const PhotonPilot>(scene, PhotonChoice{20000, {}, false}, SamplerKind::sobol, 0);
    const PictureSampler sampler(
        scene, {.method = std::make_shared<const PhotonPaths>(pilot), .walk = {.bounces = 3}, .replicate_size = 4});
    const double radius = pilot->settings.radius;
    int followed = 0;
    for (std::uint32_t pixel = 0; pixel < 256; pixel += 17) {
        const Replay found = replay(sampler, {pixel, 6});
        const auto light = std::ranges::find_if(found.steps, [](const ReplayedStep& s) { return s.step.from_light; });
        if (light == found.steps.end()) continue;
        ++followed;
        EXPECT_EQ(light->step.kind, PathStep::Kind::first);
        EXPECT_TRUE(scene.emitters.is_emitter(light->step.from.shape));
        double nearest = std::numeric_limits<double>::infinity();
        for (auto s = light; s != found.steps.end(); ++s) {
            EXPECT_TRUE(s->step.from_light);
            if (s != light) {
                EXPECT_EQ(s->step.from.position, std::prev(s)->step.to.position);
            }
            for (auto seen = found.steps.begin(); seen != light; ++seen)
                if (seen->step.kind != PathStep::Kind::shadow_ray && seen->step.found && s->step.found)
                    nearest = std::min(nearest, glm::length(seen->step.to.position - s->step.to.position));
        }
        EXPECT_LE(nearest, radius);
    }
    EXPECT_GT(followed, 5);
}

// After the walk comes a ray of the record that brings most, and then the rays by which it goes on.
TEST(Replay, ARecordIsFollowedAlongItsBrightestRay) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "16"}});
    const auto places =
        std::make_shared<const RecordPlaces>(scene, CacheSettings{Spacing::hessian, 0.1, 64}, SamplerKind::sobol, 0, 1e9);
    const PictureSampler sampler(
        scene, {.method = std::make_shared<const CachePaths>(places), .walk = {.bounces = 3}, .replicate_size = 4});
    int followed = 0;
    for (std::uint32_t pixel = 0; pixel < 256; pixel += 17) {
        const Replay found = replay(sampler, {pixel, 6});
        const auto ray =
            std::ranges::find_if(found.steps, [](const ReplayedStep& s) { return s.step.kind == PathStep::Kind::record; });
        if (ray == found.steps.end()) continue;
        ++followed;
        const auto& records = places->records();
        const auto record = std::ranges::find_if(records, [&](const Record& r) { return r.x.position == ray->step.from.position; });
        ASSERT_NE(record, records.end());
        EXPECT_TRUE(record->is_seen);
        EXPECT_GT(glm::dot(record->frame.n, ray->step.w), 0.0);
        double nearest = std::numeric_limits<double>::infinity();
        for (auto seen = found.steps.begin(); seen != ray; ++seen)
            if (seen->step.kind != PathStep::Kind::shadow_ray && seen->step.found)
                nearest = std::min(nearest, glm::length(seen->step.to.position - record->x.position));
        EXPECT_LE(nearest, record->radius);
        for (auto s = ray; s != found.steps.end(); ++s) EXPECT_TRUE(s->found.empty());
    }
    EXPECT_GT(followed, 5);
}

// Of a walk by itself: its rays are joined, and its weight is the product of what the reflections leave of it.
TEST(Replay, APathIsJoined) {
    const Scene scene = read_scene(SCENES "/furnace/furnace.xml", {{"res", "4"}, {"albedo", ".25,.5,.75"}});
    const SamplingSettings settings{.walk = {.bounces = 3, .rest_probability = 0.0}, .replicate_size = 1};
    const Replay found = replay(PictureSampler(scene, settings), {5, 3});
    Rgb weight(1.0);
    SurfacePoint at;
    int reflections = 0;
    for (const auto& [step, brought] : found.steps) {
        if (step.kind == PathStep::Kind::shadow_ray) {
            EXPECT_EQ(step.bounce, reflections + 1);
            continue;
        }
        EXPECT_EQ(step.bounce, step.kind == PathStep::Kind::first ? 0 : ++reflections);
        if (step.kind == PathStep::Kind::goes_on) {
            weight *= Rgb(0.25, 0.5, 0.75);
            EXPECT_EQ(step.from.position, at.position);
            EXPECT_GT(step.pdf, 0.0);
        }
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(step.beta[c], weight[c], 1e-15);
        EXPECT_TRUE(step.found);
        at = step.to;
    }
    EXPECT_EQ(reflections, 3);
}

}  // namespace neumann::replay_test
