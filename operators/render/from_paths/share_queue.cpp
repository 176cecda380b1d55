#include "operators/render/from_paths/share_queue.h"

namespace neumann {

ShareQueue::~ShareQueue() {
    drop();
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    changed_.notify_all();
}

void ShareQueue::add(const Share& share, const Tally& tally) {
    const std::lock_guard lock(mutex_);
    to_do_.emplace_back(share, without_smaller_samples(tally));
    changed_.notify_all();
}

std::size_t ShareQueue::waiting() const {
    const std::lock_guard lock(mutex_);
    return to_do_.size() + (is_busy_ ? 1 : 0);
}

std::optional<std::pair<Share, SampledShare>> ShareQueue::take() {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    if (done_.empty()) return std::nullopt;
    std::pair first = std::move(done_.front());
    done_.pop_front();
    return first;
}

void ShareQueue::wait_for(std::chrono::microseconds time) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, time, [&] { return failure_ || !done_.empty(); });
}

void ShareQueue::drop() {
    std::unique_lock lock(mutex_);
    to_do_.clear();
    is_dropped_ = true;
    changed_.wait(lock, [&] { return !is_busy_; });
    is_dropped_ = false;
    done_.clear();
}

void ShareQueue::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [&] { return is_over_ || !to_do_.empty(); });
        if (is_over_) return;
        const auto [share, tally] = std::move(to_do_.front());
        to_do_.pop_front();
        is_busy_ = true;
        lock.unlock();
        std::optional<SampledShare> sampled;
        std::exception_ptr failure;
        try {
            sampled = sampler_.sample(share, tally, {.stop = [&] { return is_dropped_.load(); }});
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        is_busy_ = false;
        if (sampled) done_.emplace_back(share, std::move(*sampled));
        if (failure) failure_ = failure;
        changed_.notify_all();
    }
}

}  // namespace neumann
