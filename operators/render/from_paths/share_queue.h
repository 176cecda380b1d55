// Shares that a thread of this process samples one after the other, while another thread can read messages.
#pragma once

#include "operators/render/from_paths/picture_sampler.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace neumann {

class ShareQueue {
public:
    // Keeps a reference to the sampler.
    explicit ShareQueue(const PictureSampler& sampler) : sampler_(sampler), thread_([this] { run(); }) {}
    ~ShareQueue();

    void add(const Share& share, const Tally& tally);
    // The number of shares that are not sampled yet.
    std::size_t waiting() const;
    // A share that is sampled, if there is one. Throws what the sampling threw.
    std::optional<std::pair<Share, SampledShare>> take();
    // Returns when a share can be taken, or after this time.
    void wait_for(std::chrono::microseconds time);
    // Forgets all shares, including the one that is being sampled.
    void drop();

private:
    void run();

    const PictureSampler& sampler_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::pair<Share, Tally>> to_do_;
    std::deque<std::pair<Share, SampledShare>> done_;
    std::exception_ptr failure_;
    std::atomic<bool> is_dropped_ = false;
    bool is_busy_ = false, is_over_ = false;
    std::jthread thread_;
};

}  // namespace neumann
