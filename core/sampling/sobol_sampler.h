// Sobol' points with Owen's nested scrambling, in replicates: each run of `replicate_size` samples of a pixel is one scrambled net,
// replicates and pixels are independent of each other. So the mean of a replicate is an unbiased estimate, and the spread of the
// replicates' means its error. Direction numbers: Joe and Kuo 2008 (Boost); Owen 1995; scrambling by hashing: Laine and Karras 2011 in
// the form of Vegdahl 2021.
#pragma once

#include "core/base/vec.h"
#include "core/sampling/counter_based.h"

#include <memory>
#include <vector>

namespace neumann {

// The first points of the sequence, bits reversed, by dimension; shared by all pixels.
class SobolPoints {
public:
    static constexpr std::uint32_t dimensions = 128;

    // `size`: a power of two.
    explicit SobolPoints(std::uint32_t size);

    std::uint32_t size() const { return size_; }
    std::uint32_t reversed(std::uint32_t dimension, std::uint32_t index) const { return reversed_[dimension * size_ + index]; }

private:
    std::uint32_t size_;
    std::vector<std::uint32_t> reversed_;
};

// Numbers of one sample of a pixel. Copies share the scrambles of their pixel, so they must be on the same replicate at any time.
class SobolSampler {
public:
    SobolSampler(const SobolPoints& points, std::uint64_t seed, std::uint32_t pixel)
        : points_(&points), random_(seed, pixel), scrambles_(std::make_shared<Scrambles>()) {}

    void start(std::uint64_t sample) {
        const std::uint64_t replicate = sample / points_->size();
        index_ = static_cast<std::uint32_t>(sample % points_->size());
        if (replicate != scrambles_->replicate) scrambles_->known = 0;
        scrambles_->replicate = replicate;
        sample_ = sample;
        dimension_ = 0;
    }

    double next() {
        const std::uint32_t d = dimension_++;
        if (d >= SobolPoints::dimensions) return beyond(d);
        if (d >= scrambles_->known) learn_scrambles();
        return to_unit_interval(scramble(points_->reversed(d, index_), scrambles_->seed[d]));
    }
    Vec2 next2() {
        const double x = next();
        return {x, next()};
    }

private:
    struct Scrambles {
        std::uint64_t replicate = ~std::uint64_t{0};
        std::uint32_t known = 0;  // dimensions
        std::array<std::uint32_t, SobolPoints::dimensions> seed;
    };
    static constexpr std::uint32_t no_scramble_block = 0x80000000u;  // keeps the two uses of the counter apart

    static std::uint32_t reverse(std::uint32_t x) {
        x = __builtin_bswap32(x);
        x = (x & 0x0f0f0f0fu) << 4 | (x & 0xf0f0f0f0u) >> 4;
        x = (x & 0x33333333u) << 2 | (x & 0xccccccccu) >> 2;
        return (x & 0x55555555u) << 1 | (x & 0xaaaaaaaau) >> 1;
    }
    // Each bit of the result depends on the higher bits of the point only (lower ones here, reversed): a nested permutation.
    static std::uint32_t scramble(std::uint32_t reversed, std::uint32_t seed) {
        std::uint32_t x = reversed;
        x ^= x * 0x3d20adeau;
        x += seed;
        x *= (seed >> 16) | 1u;
        x ^= x * 0x05526c56u;
        x ^= x * 0x53a22864u;
        return reverse(x);
    }
    void learn_scrambles() {
        const auto bits = random_(scrambles_->replicate, scrambles_->known / 4);
        for (const std::uint32_t b : bits) scrambles_->seed[scrambles_->known++] = b;
    }
    // Dimensions that the table does not have, deep in long walks: independent numbers.
    double beyond(std::uint32_t d) {
        const std::uint32_t lane = d % 4;
        if (lane == 0) bits_ = random_(sample_, no_scramble_block | d / 4);
        return to_unit_interval(bits_[lane]);
    }

    const SobolPoints* points_;
    CounterBased random_;
    std::shared_ptr<Scrambles> scrambles_;
    std::uint64_t sample_ = 0;
    std::uint32_t index_ = 0, dimension_ = 0;
    std::array<std::uint32_t, 4> bits_{};
};

}  // namespace neumann
