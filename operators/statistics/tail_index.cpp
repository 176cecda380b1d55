#include "operators/statistics/tail_index.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace neumann {

void LargestSamples::insert(double x) {
    heap_.push_back(x);
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    if (heap_.size() > capacity) {
        std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
        heap_.pop_back();
    }
    if (heap_.size() == capacity) threshold_ = heap_.front();
}

void LargestSamples::merge(const LargestSamples& other) {
    count_ += other.count_;
    for (const double x : other.heap_)
        if (x > threshold_) insert(x);
}

std::vector<double> LargestSamples::sorted() const {
    std::vector<double> values = heap_;
    std::sort(values.begin(), values.end(), std::greater<>());
    return values;
}

std::optional<TailIndex> tail_index(const LargestSamples& samples) {
    const std::vector<double> largest = samples.sorted();
    const std::size_t k = std::min<std::size_t>({LargestSamples::capacity, largest.size(), samples.count() / 200});
    if (k < 100) return std::nullopt;
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < k; ++i) sum += std::log(largest[i] / largest[k - 1]);
    if (sum == 0.0) return std::nullopt;  // all equal: bounded
    const double n = static_cast<double>(k - 1), alpha = n / sum;
    return TailIndex{alpha, alpha * (1.0 + 3.1 / std::sqrt(n))};
}

}  // namespace neumann
