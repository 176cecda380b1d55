// Sobol' points with Owen's nested scrambling, in replicates: each run of `replicate_size` samples of a pixel is one scrambled net,
// and replicates and pixels are independent of each other. The mean of a replicate is therefore an unbiased estimate, and the
// spread of the replicates' means gives its error. Direction numbers: Joe and Kuo 2008 (Boost); Owen 1995; scrambling by hashing:
// Laine and Karras 2011 in the form of Vegdahl 2021. Only the first four dimensions, which are the best, are used: each further
// four are the same points in another order (padding: Burley, Practical Hash-Based Owen Scrambling, 2020).
#pragma once

#include "core/base/vec.h"
#include "core/sampling/counter_based.h"

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

namespace neumann {

// The first points of the sequence, with reversed bits; shared by all pixels.
class SobolPoints {
public:
    static constexpr std::uint32_t dimensions = 4, log2_largest_part = 6;
    using Numbers = std::array<std::uint32_t, dimensions>;

    // `size`: a power of two.
    explicit SobolPoints(std::uint32_t size);

    std::uint32_t size() const { return size_; }
    std::uint32_t log2_size() const { return log2_size_; }

    // The points in another order and scrambled, by nested permutations of the indices (`order`) and of the coordinates (`seeds`).
    // Of these, those from `first` on are written, at most 2^log2_largest_part.
    void scramble(std::uint32_t order, const Numbers& seeds, std::uint32_t first, std::span<Numbers> numbers) const;

private:
    std::uint32_t size_, log2_size_;
    std::vector<Numbers> reversed_;
    std::vector<std::uint32_t> reversed_index_;  // as a 32-bit fraction of `size`
};

// The random numbers of one sample of a pixel. Copies share the scrambled points of their pixel, which are made for up to 64
// samples at once.
class SobolSampler {
public:
    SobolSampler(const SobolPoints& points, std::uint64_t seed, std::uint32_t pixel)
        : points_(&points),
          random_(seed, pixel),
          scrambled_(std::make_shared<Scrambled>(std::min(points.log2_size(), SobolPoints::log2_largest_part))) {}

    void start(std::uint64_t sample) {
        sample_ = sample;
        dimension_ = 0;
    }

    double next() {
        const std::uint32_t lane = dimension_ % SobolPoints::dimensions;
        if (lane == 0) start_group(dimension_ / SobolPoints::dimensions);
        ++dimension_;
        return to_unit_interval(bits_[lane]);
    }
    Vec2 next2() {
        const double x = next();
        return {x, next()};
    }

private:
    // Beyond these groups of dimensions, which only long walks reach, the numbers are independent.
    static constexpr std::uint32_t scrambled_groups = 32;
    static constexpr std::uint32_t order_block = 0x40000000u, beyond_block = 0x80000000u;  // separate the uses of the counter
    // Some groups of dimensions, each of 2^log2_size samples: paths that advance together are seldom further apart.
    struct Scrambled {
        static constexpr std::size_t places = 8;
        struct Part {
            std::uint64_t samples = ~std::uint64_t{0};  // from samples · 2^log2_size on
            std::uint32_t group = 0;
            bool operator==(const Part&) const = default;
        };

        explicit Scrambled(std::uint32_t log2) : log2_size(log2), numbers(places << log2) {}
        std::uint32_t log2_size;
        std::array<Part, places> parts;
        std::vector<SobolPoints::Numbers> numbers;
    };

    void start_group(std::uint32_t group) {
        if (group >= scrambled_groups) {
            bits_ = random_(sample_, beyond_block | group);
            return;
        }
        Scrambled& known = *scrambled_;
        const Scrambled::Part part{sample_ >> known.log2_size, group};
        const std::size_t place = (part.samples + group) % Scrambled::places, size = std::size_t{1} << known.log2_size;
        if (known.parts[place] != part) {
            const std::uint64_t replicate = sample_ >> points_->log2_size();
            points_->scramble(random_(replicate, order_block | group)[0], random_(replicate, group),
                              static_cast<std::uint32_t>(sample_ & (points_->size() - size)),
                              std::span(known.numbers).subspan(place * size, size));
            known.parts[place] = part;
        }
        bits_ = known.numbers[place * size + (sample_ & (size - 1))];
    }

    const SobolPoints* points_;
    CounterBased random_;
    std::shared_ptr<Scrambled> scrambled_;
    std::uint64_t sample_ = 0;
    std::uint32_t dimension_ = 0;
    SobolPoints::Numbers bits_{};  // of the current group
};

}  // namespace neumann
