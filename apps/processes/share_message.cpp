#include "apps/processes/share_message.h"

#include "core/base/packed_numbers.h"

#include <utility>

namespace neumann {

std::vector<std::byte> as_bytes(const SampledShare& sampled) {
    const Tally& tally = sampled.tally;
    constexpr std::size_t room_for_tally = 1 << 16;
    PackedNumbers out(std::span(sampled.data).size_bytes() + std::span(sampled.ranges.of).size_bytes() + room_for_tally);
    out.numbers(sampled.data);
    out.numbers(sampled.ranges.of);
    out.numbers(tally.rays);
    out.number(tally.shared_rays);
    out.number(tally.given_up);
    out.numbers(tally.non_finite_count);
    out.numbers(tally.non_finite);
    out.numbers(tally.chains);
    for (const LargestSamples& largest : tally.largest) {
        out.number(largest.count());
        out.numbers(largest.kept());
    }
    return std::move(out).bytes();
}

SampledShare sampled_share_from(std::span<const std::byte> bytes) {
    UnpackedNumbers in(bytes);
    auto data = in.numbers<double>();
    SampleRanges ranges{in.numbers<SampleRange>()};
    auto rays = in.numbers<std::uint64_t>();
    Tally tally(rays.size());
    tally.rays = std::move(rays);
    tally.shared_rays = in.number<std::uint64_t>();
    tally.given_up = in.number<std::uint64_t>();
    tally.non_finite_count = in.numbers<std::uint64_t>();
    tally.non_finite = in.numbers<NonFiniteSample>();
    tally.chains = in.numbers<ChainStatistics>();
    for (LargestSamples& largest : tally.largest) {
        const auto count = in.number<std::uint64_t>();
        largest = LargestSamples(count, in.numbers<LargestSamples::Sample>());
    }
    return {std::move(data), std::move(ranges), std::move(tally)};
}

}  // namespace neumann
