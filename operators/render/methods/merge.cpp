#include "operators/render/methods/merge.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <tuple>
#include <utility>

namespace neumann {

namespace {

std::vector<SeedRange> seeds_of(const RenderState& state) {
    if (!state.series.merged.empty()) return state.series.merged;
    return {{state.render.seed, state.series.moments.first(), state.series.moments.replicates(), state.series.sizes}};
}

void expect_alike(const NamedState& a, const NamedState& b) {
    const auto unlike = [&](const std::string& of_a, const std::string& of_b) {
        throw InputError(fmt::format("{} and {} cannot be merged: {}, and {}", a.name, b.name, of_a, of_b));
    };
    const RecordedRender &x = a.state.render, &y = b.state.render;
    const SeriesMoments &m = a.state.series.moments, &n = b.state.series.moments;
    if (x.method != y.method)
        unlike(fmt::format("one is by {}", name_of(x.method)), x.method.index() == y.method.index()
                                                                   ? "the other by the same with other options"
                                                                   : fmt::format("the other by {}", name_of(y.method)));
    if (x.bounces != y.bounces)
        unlike(fmt::format("one has bounces 0 to {}", x.bounces),
               fmt::format("the other 0 to {}; give both the same number", y.bounces));
    if (m.width() != n.width() || m.height() != n.height())
        unlike(fmt::format("one has {}×{} pixels", m.width(), m.height()), fmt::format("the other {}×{}", n.width(), n.height()));
    if (x.replicate_size != y.replicate_size)
        unlike(fmt::format("one has replicates of {} samples a pixel", x.replicate_size),
               fmt::format("the other of {}, because of its fewer or more samples", y.replicate_size));
    if ((x.rest_probability > 0.0) != (y.rest_probability > 0.0)) unlike("one has a rest", "the other has none");
}

void expect_other_samples(const std::vector<NamedState>& renders) {
    for (auto a = renders.begin(); a != renders.end(); ++a)
        for (auto b = std::next(a); b != renders.end(); ++b)
            for (const SeedRange& x : seeds_of(a->state))
                for (const SeedRange& y : seeds_of(b->state))
                    if (x.seed == y.seed && x.first < y.first + y.count && y.first < x.first + x.count)
                        throw InputError(fmt::format("{} and {} have the same samples, of seed {}; merged, these would count twice",
                                                     a->name, b->name, x.seed));
}

// Whether the renders are of one seed and consecutive, from its first replicate on.
bool are_consecutive(const std::vector<NamedState>& renders) {
    std::uint64_t next = 0;
    for (const NamedState& r : renders) {
        if (!r.state.series.merged.empty() || r.state.render.seed != renders.front().state.render.seed) return false;
        if (r.state.series.moments.first() != next) return false;
        next += r.state.series.moments.replicates();
    }
    return true;
}

// Renumbers the samples of each pixel so that they follow those of `before`.
void rename_samples(RenderState& state, const std::vector<SeedRange>& before) {
    const std::uint64_t size = state.render.replicate_size;
    const auto of_pixel = [&](const std::vector<std::uint32_t>& sizes, std::uint32_t pixel) {
        return sizes.empty() ? size : std::uint64_t{sizes[pixel]};
    };
    const RenderedSeries& series = state.series;
    const std::uint64_t first = series.merged.empty() ? series.moments.first() : 0;
    const auto rename = [&](SamplePlace& place) {
        place.name.sample -= first * of_pixel(series.sizes, place.name.pixel);
        for (const SeedRange& range : before) place.name.sample += range.count * of_pixel(range.sizes, place.name.pixel);
    };
    Tally& tally = state.series.tally;
    for (NonFiniteSample& s : tally.non_finite) rename(s.place);
    for (LargestSamples& largest : tally.largest) {
        std::vector<LargestSamples::Sample> kept = largest.kept();
        for (LargestSamples::Sample& s : kept) rename(s.place);
        largest = LargestSamples(largest.count(), std::move(kept));
    }
}

}  // namespace

RenderState merge(std::vector<NamedState> renders) {
    if (renders.size() < 2) throw InputError("there is nothing to merge, expected two renders or more");
    for (const NamedState& r : renders) expect_alike(renders.front(), r);
    expect_other_samples(renders);
    std::ranges::stable_sort(renders, {},
                             [](const NamedState& r) { return std::tuple(r.state.render.seed, r.state.series.moments.first()); });
    const bool consecutive = are_consecutive(renders);

    RenderState merged = std::move(renders.front().state);
    RenderedSeries& all = merged.series;
    std::vector<SeedRange> seeds = seeds_of(merged);
    if (!consecutive) rename_samples(merged, {});
    std::erase_if(all.convergence, [](const Checkpoint& c) { return !std::has_single_bit(c.samples); });
    for (auto r = renders.begin() + 1; r != renders.end(); ++r) {
        RenderedSeries& next = r->state.series;
        if (consecutive) {
            all.moments.add(next.moments);
        } else {
            rename_samples(r->state, seeds);
            all.moments.unite(next.moments);
        }
        for (const SeedRange& range : seeds_of(r->state)) seeds.push_back(range);
        all.tally.merge(next.tally);
        all.samples += next.samples;
        all.seconds += next.seconds;
        all.convergence.push_back(make_checkpoint(all, {}));
    }
    if (!consecutive) {
        all.merged = std::move(seeds);
        all.sizes.clear();
    }
    return merged;
}

}  // namespace neumann
