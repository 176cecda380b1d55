// Is the variance finite? The largest samples tell: where P(X > x) ~ x^−α, α ≤ 2 means that it is not, and that no interval built
// on a variance is to be trusted.
#pragma once

#include "operators/statistics/sample_place.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace neumann {

// The largest samples seen, in any order and any number of pieces: the same samples give the same set.
class LargestSamples {
public:
    static constexpr std::size_t capacity = 1000;

    // Zeros need not be added one by one: add_count() counts samples, add() looks at one.
    void add(double x, const SamplePlace& place = {}) {
        if (x > threshold_) insert({x, place});
    }
    void add_count(std::uint64_t n) { count_ += n; }
    void merge(const LargestSamples& other);
    // Samples that `other` already outdoes need not be kept: for sets that will be merged into it.
    void outdo(const LargestSamples& other) { threshold_ = std::max(threshold_, other.threshold_); }
    // add() does nothing for values up to this.
    double threshold() const { return threshold_; }

    std::uint64_t count() const { return count_; }
    // Largest first.
    std::vector<double> sorted() const;

    struct Sample {
        double value;
        SamplePlace place;
    };
    // Likewise, without those that are as large as samples that were not kept: there it is chance which have stayed.
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

// Hill's estimate (1975) from the k largest of n samples, k = min(1000, n/200), and again from the k/4 largest: a power law has the
// same index at both, while that of a bounded sample falls off faster further out. `upper` is infinite where the tail is seen to
// end. None where k < 400.
std::optional<TailIndex> tail_index(const LargestSamples& samples);

}  // namespace neumann
