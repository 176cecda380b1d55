#include "core/sampling/sampler.h"

#include "core/sampling/counter_based.h"

#include <algorithm>
#include <span>
#include <vector>

namespace neumann {

namespace {

// Beyond these groups of dimensions, which only long walks reach, the numbers are independent.
constexpr std::uint32_t scrambled_groups = 32;
constexpr std::uint32_t order_block = 0x40000000u, beyond_block = 0x80000000u;  // separate the uses of the counter

}  // namespace

// The scrambled points of some groups of dimensions, each of 2^log2_size samples: paths that advance together are
// seldom further apart.
struct Sampler::Scrambled {
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

Sampler::Sampler(const SobolPoints& points, std::uint64_t seed, std::uint32_t pixel)
    : points_(&points),
      scrambled_(std::make_shared<Scrambled>(std::min(points.log2_size(), SobolPoints::log2_largest_part))),
      seed_(seed),
      pixel_(pixel) {}

void Sampler::start_group(std::uint32_t group) {
    const CounterBased random(seed_, pixel_);
    if (!points_) {
        bits_ = random(sample_, group);
        return;
    }
    if (group >= scrambled_groups) {
        bits_ = random(sample_, beyond_block | group);
        return;
    }
    Scrambled& known = *scrambled_;
    const Scrambled::Part part{sample_ >> known.log2_size, group};
    const std::size_t place = (part.samples + group) % Scrambled::places, size = std::size_t{1} << known.log2_size;
    if (known.parts[place] != part) {
        const std::uint64_t replicate = sample_ >> points_->log2_size();
        points_->scramble(random(replicate, order_block | group)[0], random(replicate, group),
                          static_cast<std::uint32_t>(sample_ & (points_->size() - size)),
                          std::span(known.numbers).subspan(place * size, size));
        known.parts[place] = part;
    }
    bits_ = known.numbers[place * size + (sample_ & (size - 1))];
}

}  // namespace neumann
