#include "core/sampling/sobol_points.h"

#include "core/base/hot.h"

#include <bit>
#include <boost/random/sobol.hpp>
#include <cstring>

namespace neumann {

namespace {

// Four numbers side by side, as all x86-64 processors have them.
using Four [[gnu::vector_size(16)]] = std::uint32_t;

template <class Bits>
Bits reverse(Bits x) {
    x = x >> 16 | x << 16;
    x = (x & 0x00ff00ffu) << 8 | (x & 0xff00ff00u) >> 8;
    x = (x & 0x0f0f0f0fu) << 4 | (x & 0xf0f0f0f0u) >> 4;
    x = (x & 0x33333333u) << 2 | (x & 0xccccccccu) >> 2;
    return (x & 0x55555555u) << 1 | (x & 0xaaaaaaaau) >> 1;
}

// Each bit of the result depends only on itself and the higher bits of the point (lower bits here, as they are reversed): a nested
// permutation.
template <class Bits>
Bits permute(Bits reversed, Bits seed) {
    Bits x = reversed;
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reverse(x);
}

}  // namespace

SobolPoints::SobolPoints(std::uint32_t size)
    : size_(size), log2_size_(static_cast<std::uint32_t>(std::countr_zero(size))), reversed_(size), reversed_index_(size) {
    // Boost omits the point at the origin and returns the others in Gray code order, which is the same set if the size is a power
    // of two.
    boost::random::sobol engine(dimensions);
    for (std::uint32_t index = 1; index < size; ++index) {
        for (std::uint32_t& x : reversed_[index]) x = reverse(static_cast<std::uint32_t>(engine() >> 32));
        reversed_index_[index] = reverse(static_cast<std::uint32_t>(std::uint64_t{index} << 32 >> log2_size_));
    }
}

NEUMANN_HOT void SobolPoints::scramble(std::uint32_t order, const Numbers& seeds, std::uint32_t first,
                                       std::span<Numbers> numbers) const {
    std::uint32_t place[1u << log2_largest_part];
    for (std::size_t i = 0; i < numbers.size(); ++i) place[i] = permute(reversed_index_[first + i], order);
    Four seed;
    std::memcpy(&seed, seeds.data(), sizeof seed);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        Four x;
        std::memcpy(&x, reversed_[std::uint64_t{place[i]} << log2_size_ >> 32].data(), sizeof x);
        x = permute(x, seed);
        std::memcpy(numbers[i].data(), &x, sizeof x);
    }
}

}  // namespace neumann
