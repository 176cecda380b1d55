// Sobol' points with Owen's nested scrambling, in replicates: each run of `replicate_size` samples of a pixel is one scrambled net,
// and replicates and pixels are independent of each other. The mean of a replicate is therefore an unbiased estimate, and the
// spread of the replicates' means gives its error. Direction numbers: Joe and Kuo 2008 (Boost); Owen 1995; scrambling by hashing:
// Laine and Karras 2011 in the form of Vegdahl 2021. Only the first four dimensions, which are the best, are used: each further
// four are the same points in another order (padding: Burley, Practical Hash-Based Owen Scrambling, 2020).
#pragma once

#include "core/base/vec.h"
#include "core/sampling/counter_based.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace neumann {

// The first points of the sequence, with reversed bits, by dimension; shared by all pixels.
class SobolPoints {
public:
    static constexpr std::uint32_t dimensions = 4;

    // `size`: a power of two.
    explicit SobolPoints(std::uint32_t size);

    std::uint32_t size() const { return size_; }
    std::uint32_t log2_size() const { return log2_size_; }
    std::uint32_t reversed(std::uint32_t dimension, std::uint32_t index) const { return reversed_[dimension * size_ + index]; }

private:
    std::uint32_t size_, log2_size_;
    std::vector<std::uint32_t> reversed_;
};

// The random numbers of one sample of a pixel. Copies share the scrambling seeds of their pixel, so all copies must be at the same
// replicate at any time.
class SobolSampler {
public:
    SobolSampler(const SobolPoints& points, std::uint64_t seed, std::uint32_t pixel)
        : points_(&points), random_(seed, pixel), scrambles_(std::make_shared<Scrambles>()) {}

    void start(std::uint64_t sample) {
        const std::uint32_t size = points_->size(), bits = points_->log2_size();
        const std::uint64_t replicate = sample >> bits;
        // The index in the replicate as a 32-bit fraction of `size`, with reversed bits.
        reversed_index_ = reverse(static_cast<std::uint32_t>((sample & (size - 1)) << 32 >> bits));
        if (replicate != scrambles_->replicate) scrambles_->known = 0;
        scrambles_->replicate = replicate;
        sample_ = sample;
        dimension_ = 0;
    }

    double next() {
        const std::uint32_t d = dimension_++;
        if (d >= scrambled_dimensions) return beyond(d);
        if (d % SobolPoints::dimensions == 0) start_group(d / SobolPoints::dimensions);
        return to_unit_interval(scramble(points_->reversed(d % SobolPoints::dimensions, index_), scrambles_->seed[d]));
    }
    Vec2 next2() {
        const double x = next();
        return {x, next()};
    }

private:
    // Beyond these dimensions, which only long walks reach, the numbers are independent.
    static constexpr std::uint32_t scrambled_dimensions = 128, groups = scrambled_dimensions / SobolPoints::dimensions;
    struct Scrambles {
        std::uint64_t replicate = ~std::uint64_t{0};
        std::uint32_t known = 0;  // number of groups of dimensions whose seeds are computed
        std::array<std::uint32_t, scrambled_dimensions> seed;
        std::array<std::uint32_t, groups> order;
    };
    static constexpr std::uint32_t order_block = 0x40000000u, beyond_block = 0x80000000u;  // separate the uses of the counter

    static std::uint32_t reverse(std::uint32_t x) {
        x = __builtin_bswap32(x);
        x = (x & 0x0f0f0f0fu) << 4 | (x & 0xf0f0f0f0u) >> 4;
        x = (x & 0x33333333u) << 2 | (x & 0xccccccccu) >> 2;
        return (x & 0x55555555u) << 1 | (x & 0xaaaaaaaau) >> 1;
    }
    // Each bit of the result depends only on itself and the higher bits of the point (lower bits here, as they are reversed): a
    // nested permutation.
    static std::uint32_t scramble(std::uint32_t reversed, std::uint32_t seed) {
        std::uint32_t x = reversed;
        x ^= x * 0x3d20adeau;
        x += seed;
        x *= (seed >> 16) | 1u;
        x ^= x * 0x05526c56u;
        x ^= x * 0x53a22864u;
        return reverse(x);
    }
    void start_group(std::uint32_t group) {
        if (group >= scrambles_->known) {
            const auto seeds = random_(scrambles_->replicate, group);
            std::copy(seeds.begin(), seeds.end(), scrambles_->seed.begin() + group * SobolPoints::dimensions);
            scrambles_->order[group] = random_(scrambles_->replicate, order_block | group)[0];
            scrambles_->known = group + 1;
        }
        index_ =
            static_cast<std::uint32_t>(std::uint64_t{scramble(reversed_index_, scrambles_->order[group])} * points_->size() >> 32);
    }
    double beyond(std::uint32_t d) {
        const std::uint32_t lane = d % 4;
        if (lane == 0) bits_ = random_(sample_, beyond_block | d / 4);
        return to_unit_interval(bits_[lane]);
    }

    const SobolPoints* points_;
    CounterBased random_;
    std::shared_ptr<Scrambles> scrambles_;
    std::uint64_t sample_ = 0;
    std::uint32_t reversed_index_ = 0, index_ = 0, dimension_ = 0;
    std::array<std::uint32_t, 4> bits_{};
};

}  // namespace neumann
