#include "operators/statistics/tail_index.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace neumann {

namespace {

bool larger(const LargestSamples::Sample& a, const LargestSamples::Sample& b) { return a.value > b.value; }

}  // namespace

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
    const auto hill = [&](std::size_t of) {
        double sum = 0.0;
        for (std::size_t i = 0; i + 1 < of; ++i) sum += std::log(largest[i] / largest[of - 1]);
        const auto n = static_cast<double>(of - 1);
        const double alpha = n / sum;  // infinite where all are equal
        return TailIndex{alpha, alpha * (1.0 + 3.1 / std::sqrt(n))};
    };
    const TailIndex near = hill(k), far = hill(k / 4);
    if (!std::isfinite(near.alpha)) return std::nullopt;
    return TailIndex{near.alpha, std::max(near.upper, far.upper)};
}

}  // namespace neumann
