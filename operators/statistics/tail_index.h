// Judges from the largest samples whether the variance is finite: it is not if P(X > x) ~ x^−α with α ≤ 2, and then
// intervals computed from a variance do not hold.
#pragma once

#include "operators/statistics/sample_place.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace neumann {

// The set of the largest samples. It does not depend on the order in which samples are added or sets are merged.
class LargestSamples {
public:
    static constexpr std::size_t capacity = 1000;
    LargestSamples() = default;

    // add() does not count the sample; add_count() counts samples. Zeros therefore need not be added one by one.
    void add(double x, const SamplePlace& place = {}) {
        if (x > threshold_) insert({x, place});
    }
    void add_count(std::uint64_t n) { count_ += n; }
    void merge(const LargestSamples& other);
    // `this` will be merged into `other`: samples that are too small for `other` need not be kept.
    void outdo(const LargestSamples& other) { outdo(other.threshold_); }
    void outdo(double threshold) { threshold_ = std::max(threshold_, threshold); }
    // add() ignores values up to this.
    double threshold() const { return threshold_; }

    std::uint64_t count() const { return count_; }
    // Largest first.
    std::vector<double> sorted() const;

    struct Sample {
        double value;
        SamplePlace place;
    };
    // The samples that are kept, in no order. The constructor makes the set from them again.
    const std::vector<Sample>& kept() const { return heap_; }
    LargestSamples(std::uint64_t count, std::vector<Sample> kept);
    // The samples with the largest first, without those whose value equals that of samples not kept: among these,
    // chance decided which were kept.
    std::vector<Sample> standing_out() const;

private:
    void insert(const Sample& sample);
    std::uint64_t count_ = 0;
    double threshold_ = 0.0;
    std::vector<Sample> heap_;  // smallest on top
};

struct TailIndex {
    double alpha;  // Hill's estimate
    double upper;  // α is below this with about 99.9% confidence: the larger of two such bounds
    bool variance_is_infinite() const { return upper < 2.0; }
};

// Hill's estimate (1975) from the k largest of n samples, k = min(1000, n/200), and again from the k/4 largest: a power
// law has the same index in both, while the tail of a bounded distribution falls faster further out. `upper` is
// infinite if the samples show that the tail ends. Returns nothing if k < 400.
std::optional<TailIndex> tail_index(const LargestSamples& samples);

}  // namespace neumann
