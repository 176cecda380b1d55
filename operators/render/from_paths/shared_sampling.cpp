#include "operators/render/from_paths/shared_sampling.h"

#include <algorithm>
#include <chrono>
#include <iterator>

namespace neumann {

namespace {

// The number of shares of a node per process: they are small enough that nobody waits long for the last one.
constexpr std::uint32_t pieces_each = 8;
// The number of shares queued in this process: the one being sampled and the next.
constexpr std::size_t shares_here = 2;
// How often messages are looked for, which takes time from the thread that samples.
constexpr std::chrono::milliseconds moment(2);

}  // namespace

SharedSampling::SharedSampling(const PictureSampler& sampler, Helpers& helpers, NodeAt node_at)
    : sampler_(sampler),
      helpers_(helpers),
      node_at_(std::move(node_at)),
      pieces_(pieces_each * (static_cast<std::uint32_t>(helpers.count()) + 1)),
      here_(sampler) {}

std::optional<MomentsNode> SharedSampling::run(std::uint64_t first, std::uint64_t count, Tally& tally, const Watch& watch,
                                               std::vector<double> memory) {
    if (!nodes_.empty() && nodes_.front() != std::pair(first, count)) drop();
    if (nodes_.empty()) plan(first, count);
    shares_of_node_ = sampler_.shares(first, count, pieces_).size();
    std::size_t joined = 0;
    const auto next = [&](const Share& share) -> std::optional<SampledShare> {
        for (;;) {
            collect();
            plan_ahead();
            hand_out(tally);
            if (auto found = done_.extract(share)) {
                watch.progress({.fraction = static_cast<double>(++joined) / static_cast<double>(shares_of_node_)});
                return std::move(found.mapped());
            }
            if (watch.stop()) return std::nullopt;
            here_.wait_for(moment);
        }
    };
    auto node = sampler_.join(first, count, pieces_, tally, next, std::move(memory));
    if (node)
        nodes_.pop_front();
    else
        drop();
    return node;
}

void SharedSampling::plan(std::uint64_t first, std::uint64_t count) {
    nodes_.emplace_back(first, count);
    std::ranges::copy(sampler_.shares(first, count, pieces_), std::back_inserter(to_do_));
}

// Plans nodes only up to a limit, because planned shares stay in memory until they are joined.
void SharedSampling::plan_ahead() {
    const std::size_t most = 2 * std::max(shares_of_node_, static_cast<std::size_t>(helpers_.count()) + 1);
    while (to_do_.size() + under_way_ + done_.size() < most) {
        const auto [last, its_count] = nodes_.back();
        const std::uint64_t count = node_at_(last + its_count);
        if (count == 0) return;
        plan(last + its_count, count);
    }
}

void SharedSampling::hand_out(const Tally& tally) {
    for (; !to_do_.empty(); to_do_.pop_front(), ++under_way_) {
        if (here_.waiting() == 0)
            here_.add(to_do_.front(), tally);
        else if (!helpers_.give(to_do_.front(), tally)) {
            if (here_.waiting() >= shares_here) return;
            here_.add(to_do_.front(), tally);
        }
    }
}

void SharedSampling::collect() {
    const auto keep = [&](std::pair<Share, SampledShare> one) {
        done_.insert(std::move(one));
        --under_way_;
    };
    while (auto one = here_.take()) keep(std::move(*one));
    while (auto one = helpers_.take()) keep(std::move(*one));
}

void SharedSampling::drop() {
    here_.drop();
    helpers_.drop();
    nodes_.clear();
    to_do_.clear();
    done_.clear();
    under_way_ = 0;
}

}  // namespace neumann
