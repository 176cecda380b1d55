// The replicates of a render, sampled together with other processes. The result does not depend on who samples what.
#pragma once

#include "operators/render/from_paths/share_queue.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <utility>

namespace neumann {

class SharedSampling {
public:
    // The number of replicates in the node that begins with replicate `first`; 0 if no such node is known to be needed.
    using NodeAt = std::function<std::uint64_t(std::uint64_t first)>;

    // Keeps references to sampler and helpers.
    SharedSampling(const PictureSampler& sampler, Helpers& helpers, NodeAt node_at);
    ~SharedSampling() { drop(); }

    // As PictureSampler::run(). While the last shares of a node are under way, those of the nodes after it are begun.
    std::optional<MomentsNode> run(std::uint64_t first, std::uint64_t count, Tally& tally, const Watch& watch,
                                   std::vector<double> memory);

private:
    void plan(std::uint64_t first, std::uint64_t count);
    void plan_ahead();
    void hand_out(const Tally& tally);
    void collect();
    void drop();

    const PictureSampler& sampler_;
    Helpers& helpers_;
    NodeAt node_at_;
    std::uint32_t pieces_;
    ShareQueue here_;
    // Planned nodes: first replicate and number of replicates.
    std::deque<std::pair<std::uint64_t, std::uint64_t>> nodes_;
    std::deque<Share> to_do_;  // the shares of these nodes, in order
    std::size_t under_way_ = 0;
    std::map<Share, SampledShare> done_;
    std::size_t shares_of_node_ = 1;
};

}  // namespace neumann
