// The same seed and the same samples give the same bits: whatever the number of threads, and however a run was cut into blocks.
#include "core/reader/read_scene.h"
#include "operators/render/from_paths/picture_sampler.h"
#include "operators/render/methods/method_options.h"
#include "operators/render/methods/sampling.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cstring>
#include <map>

namespace neumann::determinism_pictures_test {

struct Case {
    const char* name;
    const char* method;  // as read_method() reads it
    friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
};

const Scene& cornell_box() {
    static const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "20"}});
    return scene;
}

// With what the method needs before its first sample. Walks are given up soon, so that this is counted, too.
PictureSampler::Settings made_settings(const Case& c, std::uint64_t seed) {
    constexpr int bounces = 3;
    const Method method = read_method(c.method);
    SamplingSettings settings = sampling_settings(method, cornell_box(), {}, seed);
    settings.walk.bounces = bounces;
    settings.walk.rest_probability = std::holds_alternative<method::Pointwise>(method) ? 0.0 : 0.7;
    settings.walk.give_up = 4;
    settings.replicate_size = 4;
    Prepared prepared(seed);
    set_up(method, cornell_box(), bounces, 1e9, settings, prepared);
    return settings;
}
const PictureSampler::Settings& settings(const Case& c, std::uint64_t seed = 3) {
    static std::map<std::pair<std::string, std::uint64_t>, PictureSampler::Settings> made;
    const auto [there, is_new] = made.try_emplace({c.method, seed});
    if (is_new) there->second = made_settings(c, seed);
    return there->second;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}
bool same_bits(const Image& a, const Image& b) {
    return a.pixels.size() == b.pixels.size() && std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Rgb)) == 0;
}

void expect_same(const Tally& a, const Tally& b) {
    EXPECT_EQ(a.rays, b.rays);
    EXPECT_EQ(a.given_up, b.given_up);
    EXPECT_EQ(a.non_finite_count, b.non_finite_count);
    EXPECT_TRUE(a.non_finite == b.non_finite);
    for (std::size_t q = 0; q < a.largest.size(); ++q) {
        EXPECT_EQ(a.largest[q].count(), b.largest[q].count());
        EXPECT_TRUE(same_bits(a.largest[q].sorted(), b.largest[q].sorted())) << q;
        const auto of_a = a.largest[q].standing_out(), of_b = b.largest[q].standing_out();
        ASSERT_EQ(of_a.size(), of_b.size());
        for (std::size_t i = 0; i < of_a.size(); ++i) EXPECT_EQ(of_a[i].place, of_b[i].place) << q;
    }
}
void expect_same(const SeriesMoments& a, const SeriesMoments& b) {
    ASSERT_EQ(a.nodes().size(), b.nodes().size());
    for (std::size_t i = 0; i < a.nodes().size(); ++i) {
        EXPECT_EQ(a.nodes()[i].first, b.nodes()[i].first);
        EXPECT_EQ(a.nodes()[i].count, b.nodes()[i].count);
        EXPECT_TRUE(same_bits(*a.nodes()[i].data, *b.nodes()[i].data));
    }
    const auto ra = a.result(), rb = b.result();
    EXPECT_EQ(ra.degrees_of_freedom(), rb.degrees_of_freedom());
    for (std::size_t q = 0; q < ra.quantities(); ++q)
        for (const auto read : {&SeriesMoments::Result::term, &SeriesMoments::Result::sum}) {
            EXPECT_TRUE(same_bits((ra.*read)(q).mean, (rb.*read)(q).mean)) << q;
            EXPECT_TRUE(same_bits((ra.*read)(q).standard_error, (rb.*read)(q).standard_error)) << q;
        }
}

class Determinism : public testing::TestWithParam<Case> {};

// Also what is made before the first sample.
TEST_P(Determinism, OneTwoAndSevenThreadsGiveTheSameBits) {
    struct Outcome {
        SeriesMoments moments;
        Tally tally;
    };
    const auto with_threads = [&](int threads) {
        // More threads than cores, if need be: an arena of that size, which the control lets have its workers.
        oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(threads));
        oneapi::tbb::task_arena arena(threads);
        return arena.execute([&] {
            const PictureSampler sampler(cornell_box(), made_settings(GetParam(), 3));
            Outcome outcome{SeriesMoments(sampler.width(), sampler.height(), sampler.quantities()), Tally(sampler.quantities())};
            outcome.moments.add(*sampler.run(0, 8, outcome.tally));
            outcome.moments.add(*sampler.run(8, 2, outcome.tally));
            return outcome;
        });
    };
    const Outcome one = with_threads(1);
    if (std::string_view(GetParam().method).starts_with("walk")) {
        EXPECT_GT(one.tally.given_up, 0u);
    }
    for (const int threads : {2, 7, 7, 7}) {
        SCOPED_TRACE(threads);
        const Outcome other = with_threads(threads);
        expect_same(one.moments, other.moments);
        expect_same(one.tally, other.tally);
    }
}

// All 26 ways to cut [0, 8) into nodes, and all ways to join it from two or three ranges.
TEST_P(Determinism, BlocksOfReplicatesMergeToTheSameBits) {
    const Scene& scene = cornell_box();
    const PictureSampler sampler(scene, settings(GetParam()));
    struct Piece {
        MomentsNode node;
        Tally tally;
    };
    std::map<std::pair<std::uint64_t, std::uint64_t>, Piece> pieces;  // by first and count; the last ones first
    for (const std::uint64_t count : {1, 2, 4, 8})
        for (std::uint64_t first = 8; first > 0; first -= count) {
            Tally tally(sampler.quantities());
            MomentsNode node = *sampler.run(first - count, count, tally);
            pieces.emplace(std::pair(first - count, count), Piece{std::move(node), std::move(tally)});
        }
    const auto empty = [&] { return SeriesMoments(sampler.width(), sampler.height(), sampler.quantities()); };
    SeriesMoments whole = empty();
    whole.add(pieces.at({0, 8}).node);
    ASSERT_EQ(whole.nodes().size(), 1u);

    std::vector<std::vector<std::pair<std::uint64_t, std::uint64_t>>> cuts;
    const auto cut = [](auto& self, std::uint64_t first, std::uint64_t count) -> decltype(cuts) {
        decltype(cuts) all = {{{first, count}}};
        if (count == 1) return all;
        for (const auto& left : self(self, first, count / 2))
            for (const auto& right : self(self, first + count / 2, count / 2)) {
                all.push_back(left);
                all.back().insert(all.back().end(), right.begin(), right.end());
            }
        return all;
    };
    cuts = cut(cut, 0, 8);
    EXPECT_EQ(cuts.size(), 26u);
    for (const auto& parts : cuts) {
        SeriesMoments joined = empty();
        Tally tally(sampler.quantities());
        for (const auto& part : parts) {
            joined.add(pieces.at(part).node);
            tally.merge(pieces.at(part).tally);
        }
        expect_same(joined, whole);
        expect_same(tally, pieces.at({0, 8}).tally);
    }

    // A range of replicates as one process would have it, alone.
    const auto range = [&](std::uint64_t first, std::uint64_t end) {
        SeriesMoments moments = empty();
        for (std::uint64_t i = first; i < end; ++i) moments.add(pieces.at({i, 1}).node);
        return moments;
    };
    for (std::uint64_t a = 0; a <= 8; ++a)
        for (std::uint64_t b = a; b <= 8; ++b) {
            SeriesMoments joined = range(0, a);
            joined.add(range(a, b));
            joined.add(range(b, 8));
            expect_same(joined, whole);
        }
    // Seven replicates are not a node: 4 + 2 + 1, from whichever side.
    for (std::uint64_t a = 1; a < 7; ++a) {
        SeriesMoments joined = range(0, a);
        joined.add(range(a, 7));
        expect_same(joined, range(0, 7));
    }
}

TEST_P(Determinism, ReplicatesDoNotDependOnWhatElseIsSampled) {
    const Scene& scene = cornell_box();
    const PictureSampler sampler(scene, settings(GetParam()));
    std::vector<MomentsNode> alone;
    for (std::uint64_t r = 0; r < 4; ++r) {
        const PictureSampler fresh(scene, settings(GetParam()));
        Tally tally(fresh.quantities());
        alone.push_back(*fresh.run(r, 1, tally));
    }
    Tally tally(sampler.quantities());
    (void)sampler.run(0, 16, tally);
    for (const std::uint64_t r : {3, 0, 2, 1}) EXPECT_TRUE(same_bits(sampler.run(r, 1, tally)->data, alone[r].data));
    // Other replicates, and other seeds, are others.
    EXPECT_FALSE(same_bits(alone[0].data, alone[1].data));
    const PictureSampler other(scene, settings(GetParam(), 4));
    EXPECT_FALSE(same_bits(other.run(0, 1, tally)->data, alone[0].data));
}

// A block that is dropped half way leaves no trace.
TEST_P(Determinism, ADroppedBlockLeavesNoTrace) {
    const Scene& scene = cornell_box();
    const PictureSampler sampler(scene, settings(GetParam()));
    Tally tally(sampler.quantities()), expected(sampler.quantities());
    EXPECT_FALSE(sampler.run(0, 2, tally, {.stop = [] { return true; }}));
    expect_same(tally, expected);
    const MomentsNode again = *sampler.run(0, 2, tally), plain = *sampler.run(0, 2, expected);
    EXPECT_TRUE(same_bits(again.data, plain.data));
    expect_same(tally, expected);
}

INSTANTIATE_TEST_SUITE_P(
    AllWays, Determinism,
    testing::Values(Case{"WalkIndependent", "walk:sampler=independent"}, Case{"WalkSobol", "walk:sampler=sobol"},
                    Case{"WalkAdaptive", "walk:adaptive=all"}, Case{"WalkReuse", "walk:reuse=true"},
                    Case{"WalkTree", "walk:tree=sum"}, Case{"PointwiseIndependent", "pointwise:sampler=independent"},
                    Case{"PointwiseSobol", "pointwise:sampler=sobol"}, Case{"SurfaceSobol", "surface"},
                    Case{"Shooting", "shooting"}, Case{"LightIndependent", "light:sampler=independent"},
                    Case{"LightSobol", "light:sampler=sobol"},
                    Case{"BidirectionalIndependent", "bidirectional:sampler=independent"},
                    Case{"BidirectionalSobol", "bidirectional:sampler=sobol"}, Case{"Guided", "guided:patches=200:directions=1024"},
                    Case{"Corrected", "corrected:patches=60:directions=16"}, Case{"Photon", "photon:photons=1000"},
                    Case{"PhotonGather", "photon:photons=1000:gather=true"}, Case{"Metropolis", "metropolis:chain=16"}),
    [](const auto& info) { return std::string(info.param.name); });
INSTANTIATE_TEST_SUITE_P(AllWaysSlow, Determinism,
                         testing::Values(Case{"Cache", "cache:accuracy=0.5:directions=16"}, Case{"Mixed", "mixed"}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace neumann::determinism_pictures_test
