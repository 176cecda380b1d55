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
