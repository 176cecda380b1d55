// The first points of Sobol's sequence, and Owen's nested scrambling of them. Direction numbers: Joe and Kuo 2008 (Boost); Owen
// 1995; scrambling by hashing: Laine and Karras 2011 in the form of Vegdahl 2021.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace neumann {

// The points are held with reversed bits and shared by all pixels.
class SobolPoints {
public:
    static constexpr std::uint32_t dimensions = 4, log2_largest_part = 6;
    using Numbers = std::array<std::uint32_t, dimensions>;

    // `size` must be a power of two.
    explicit SobolPoints(std::uint32_t size);

    std::uint32_t size() const { return size_; }
    std::uint32_t log2_size() const { return log2_size_; }

    // Writes points in another order and scrambled, by nested permutations of the indices (`order`) and of the
    // coordinates (`seeds`): those from `first` on, at most 2^log2_largest_part.
    void scramble(std::uint32_t order, const Numbers& seeds, std::uint32_t first, std::span<Numbers> numbers) const;

private:
    std::uint32_t size_, log2_size_;
    std::vector<Numbers> reversed_;
    std::vector<std::uint32_t> reversed_index_;  // as a 32-bit fraction of `size`
};

}  // namespace neumann
