#include "operators/statistics/tail_index.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace neumann {

namespace {

bool larger(const LargestSamples::Sample& a, const LargestSamples::Sample& b) { return a.value > b.value; }

// Hill's estimate from the k largest samples in decreasing order, and the statistic k (X_k / X_1)^α: the expected number of samples
// above the largest one if the tail is a power law, in which case it exceeds x with probability e^−x (Aban, Meerschaert and
// Panorska, Parameter Estimation for the Truncated Pareto Distribution, 2006).
struct Hill {
    double alpha, upper, missing;

    Hill(const std::vector<double>& largest, std::size_t k) {
        double sum = 0.0;
        for (std::size_t i = 0; i + 1 < k; ++i) sum += std::log(largest[i] / largest[k - 1]);
        const auto n = static_cast<double>(k - 1);
        alpha = n / sum;  // infinite if all are equal
        upper = alpha * (1.0 + 3.1 / std::sqrt(n));
        missing = static_cast<double>(k) * std::pow(largest[k - 1] / largest[0], alpha);
    }
    bool ends() const { return missing > -std::log(1e-6); }
};

}  // namespace

LargestSamples::LargestSamples(std::uint64_t count, std::vector<Sample> kept) : count_(count), heap_(std::move(kept)) {
    std::make_heap(heap_.begin(), heap_.end(), larger);
    if (heap_.size() == capacity) threshold_ = heap_.front().value;
}

void LargestSamples::insert(const Sample& sample) {
    heap_.push_back(sample);
    std::push_heap(heap_.begin(), heap_.end(), larger);
    if (heap_.size() > capacity) {
        std::pop_heap(heap_.begin(), heap_.end(), larger);
        heap_.pop_back();
    }
    if (heap_.size() == capacity) threshold_ = heap_.front().value;
}

void LargestSamples::merge(const LargestSamples& other) {
    count_ += other.count_;
    for (const Sample& sample : other.heap_)
        if (sample.value > threshold_) insert(sample);
}

std::vector<double> LargestSamples::sorted() const {
    std::vector<double> values;
    for (const Sample& sample : heap_) values.push_back(sample.value);
    std::sort(values.begin(), values.end(), std::greater<>());
    return values;
}

std::vector<LargestSamples::Sample> LargestSamples::standing_out() const {
    std::vector<Sample> samples;
    for (const Sample& sample : heap_)
        if (heap_.size() < capacity || sample.value > threshold_) samples.push_back(sample);
    std::sort(samples.begin(), samples.end(),
              [](const Sample& a, const Sample& b) { return a.value != b.value ? a.value > b.value : a.place < b.place; });
    return samples;
}

std::optional<TailIndex> tail_index(const LargestSamples& samples) {
    const std::vector<double> largest = samples.sorted();
    const std::size_t k = std::min<std::size_t>({LargestSamples::capacity, largest.size(), samples.count() / 200});
    if (k < 400) return std::nullopt;
    const Hill near(largest, k), far(largest, k / 4);
    if (!std::isfinite(near.alpha)) return std::nullopt;
    const bool ends = near.ends() && far.ends();
    return TailIndex{near.alpha, ends ? std::numeric_limits<double>::infinity() : std::max(near.upper, far.upper)};
}

}  // namespace neumann
