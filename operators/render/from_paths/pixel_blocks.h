// The blocks of a picture: a grid of about equal cells, the same for every film with this view.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace neumann {

struct PixelBlocks {
    std::uint32_t across = 1, down = 1;

    std::size_t count() const { return std::size_t{across} * down; }
    // The block of a pixel of a film of this size.
    std::size_t of(std::uint32_t pixel, std::uint32_t width, std::uint32_t height) const {
        const std::uint64_t x = pixel % width, y = pixel / width;
        return (2 * y + 1) * down / (2 * std::uint64_t{height}) * across + (2 * x + 1) * across / (2 * std::uint64_t{width});
    }
    // Calls f for the block and the blocks around it.
    template <class F>
    void for_neighbourhood(std::size_t block, const F& f) const {
        const std::size_t x = block % across, y = block / across;
        for (std::size_t v = y - std::min<std::size_t>(y, 1); v <= std::min<std::size_t>(y + 1, down - 1); ++v)
            for (std::size_t u = x - std::min<std::size_t>(x, 1); u <= std::min<std::size_t>(x + 1, across - 1); ++u)
                f(v * across + u);
    }
};

}  // namespace neumann
