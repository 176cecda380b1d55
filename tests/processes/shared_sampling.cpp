// Replicates that several helpers sample have the bits of those that one process samples, whoever did what and when.
#include "operators/render/from_paths/shared_sampling.h"
#include "apps/processes/share_message.h"
#include "core/reader/read_scene.h"
#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/methods/method_options.h"
#include "operators/render/methods/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <random>

namespace neumann::shared_sampling_test {

Scene cornell_box() { return read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "24"}}); }

// `word`: as read_method() reads it.
SamplingSettings settings(const std::string& word, const Scene& scene) {
    constexpr int bounces = 3;
    constexpr std::uint64_t seed = 5;
    const Method method = read_method(word);
    SamplingSettings all = sampling_settings(method, scene, {}, seed);
    all.walk.bounces = bounces;
    all.walk.rest_probability = std::holds_alternative<method::Pointwise>(method) ? 0.0 : 0.7;
    all.walk.give_up = 4;
    all.replicate_size = 4;
    Prepared prepared(seed);
    set_up(method, scene, bounces, 1e9, all, prepared);
    return all;
}

// Helpers in this process that sample a share at once, and hand it over after a while: some sooner, some later.
class LateHelpers : public Helpers {
public:
    LateHelpers(const PictureSampler& sampler, int count) : sampler_(sampler), count_(count) {}

    int count() const override { return count_; }
    bool give(const Share& share, const Tally& tally) override {
        if (static_cast<int>(on_the_way_.size()) >= 2 * count_) return false;
        if (fails) throw std::runtime_error("process 3: no more paper");
        const auto sampled = sampler_.sample(share, tally);
        on_the_way_.push_back({share, as_bytes(*sampled), std::uniform_int_distribution(0, 5)(random_)});
        ++given;
        return true;
    }
    std::optional<std::pair<Share, SampledShare>> take() override {
        for (auto one = on_the_way_.begin(); one != on_the_way_.end(); ++one) {
            if (one->calls_left-- > 0) continue;
            std::pair arrived(one->share, sampled_share_from(one->bytes));
            on_the_way_.erase(one);
            return arrived;
        }
        return std::nullopt;
    }
    void drop() override { on_the_way_.clear(); }

    bool fails = false;
    int given = 0;

private:
    struct Parcel {
        Share share;
        std::vector<std::byte> bytes;
        int calls_left;
    };
    const PictureSampler& sampler_;
    int count_;
    std::vector<Parcel> on_the_way_;
    std::mt19937 random_{1};
};

bool same_bits(const auto& a, const auto& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

void expect_same(const Tally& a, const Tally& b) {
    EXPECT_EQ(a.rays, b.rays);
    EXPECT_EQ(a.given_up, b.given_up);
    EXPECT_EQ(a.non_finite_count, b.non_finite_count);
    EXPECT_TRUE(a.non_finite == b.non_finite);
    ASSERT_EQ(a.largest.size(), b.largest.size());
    for (std::size_t q = 0; q < a.largest.size(); ++q) {
        EXPECT_EQ(a.largest[q].count(), b.largest[q].count());
        EXPECT_TRUE(same_bits(a.largest[q].sorted(), b.largest[q].sorted())) << q;
    }
}

void expect_same(const RenderedSeries& a, const RenderedSeries& b) {
    EXPECT_EQ(a.samples, b.samples);
    ASSERT_EQ(a.moments.nodes().size(), b.moments.nodes().size());
    for (std::size_t i = 0; i < a.moments.nodes().size(); ++i) {
        EXPECT_EQ(a.moments.nodes()[i].first, b.moments.nodes()[i].first);
        EXPECT_TRUE(same_bits(*a.moments.nodes()[i].data, *b.moments.nodes()[i].data)) << i;
    }
    EXPECT_TRUE(same_bits(a.moments.ranges().of, b.moments.ranges().of));
    expect_same(a.tally, b.tally);
}

class SharedSamplingOf : public testing::TestWithParam<const char*> {};

TEST_P(SharedSamplingOf, HasTheSameBits) {
    const Scene scene = cornell_box();
    const SamplingSettings how = settings(GetParam(), scene);
    const PictureSampler sampler(scene, how);
    const SamplingGoal goal{.samples = 4 * 37};
    const RenderedSeries alone = render_series(scene, how, goal);
    for (const int count : {1, 2, 5}) {
        SCOPED_TRACE(count);
        LateHelpers helpers(sampler, count);
        expect_same(render_series(scene, how, goal, {}, {}, &helpers), alone);
        EXPECT_GT(helpers.given, 10);
    }
}

std::string name_of(const testing::TestParamInfo<const char*>& info) {
    std::string name(info.param);
    std::ranges::replace_if(
        name, [](char c) { return !std::isalnum(c); }, '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Methods, SharedSamplingOf,
                         testing::Values("walk", "walk:adaptive=all", "walk:reuse=true", "walk:tree=sum", "pointwise", "light",
                                         "bidirectional", "guided:patches=200:directions=1024", "photon:photons=1000",
                                         "metropolis:chain=16"),
                         name_of);
INSTANTIATE_TEST_SUITE_P(MethodsSlow, SharedSamplingOf,
                         testing::Values("corrected:patches=60:directions=16", "cache:accuracy=0.5:directions=16", "mixed"),
                         name_of);

// A part of the samples, whose first replicate is not the first of all.
TEST(SharedSampling, TakesAPart) {
    const Scene scene = cornell_box();
    const SamplingSettings how = settings("walk", scene);
    const SamplingGoal goal{.samples = 4 * 21, .first = 7};
    const PictureSampler sampler(scene, how);
    LateHelpers helpers(sampler, 2);
    expect_same(render_series(scene, how, goal, {}, {}, &helpers), render_series(scene, how, goal));
}

TEST(SharedSampling, IsStoppedAndDropsWhatIsUnderWay) {
    const Scene scene = cornell_box();
    const SamplingSettings how = settings("walk", scene);
    const PictureSampler sampler(scene, how);
    LateHelpers helpers(sampler, 2);
    std::atomic<int> calls = 0;
    Watch watch;
    watch.stop = [&] { return ++calls > 30; };
    const RenderedSeries stopped = render_series(scene, how, {.samples = std::uint64_t{1} << 30}, watch, {}, &helpers);
    EXPECT_EQ(stopped.outcome, Outcome::interrupted);
    EXPECT_GT(stopped.samples, 0u);
    EXPECT_FALSE(helpers.take());
    // What is there has the bits of a render of so many samples.
    SamplingSettings same = how;
    same.replicate_size = stopped.replicate_size;
    const RenderedSeries alone = render_series(scene, same, {.samples = stopped.samples});
    EXPECT_TRUE(same_bits(stopped.moments.result().term(1).mean.pixels, alone.moments.result().term(1).mean.pixels));
}

TEST(SharedSampling, TellsOfAHelperThatFailed) {
    const Scene scene = cornell_box();
    const SamplingSettings how = settings("walk", scene);
    const PictureSampler sampler(scene, how);
    LateHelpers helpers(sampler, 2);
    helpers.fails = true;
    try {
        render_series(scene, how, {.samples = 4096}, {}, {}, &helpers);
        ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& e) {
        EXPECT_STREQ(e.what(), "process 3: no more paper");
    }
}

// A message that was cut is no share.
TEST(ShareMessage, IsReadWholeOrNotAtAll) {
    const Scene scene = cornell_box();
    const PictureSampler sampler(scene, settings("walk", scene));
    const auto shares = sampler.shares(4, 4, 3);
    ASSERT_EQ(shares.size(), 3u);
    const auto sampled = sampler.sample(shares[1], Tally(sampler.quantities()));
    const auto bytes = as_bytes(*sampled);
    const SampledShare read = sampled_share_from(bytes);
    EXPECT_TRUE(same_bits(read.data, sampled->data));
    EXPECT_TRUE(same_bits(read.ranges.of, sampled->ranges.of));
    expect_same(read.tally, sampled->tally);
    for (const std::size_t size : {std::size_t{0}, std::size_t{7}, bytes.size() / 2, bytes.size() - 1})
        EXPECT_THROW(sampled_share_from(std::span(bytes).first(size)), std::logic_error);
}

}  // namespace neumann::shared_sampling_test
