// The shares of a contribution at a position on the film: one for each pixel whose filter covers the position.
#pragma once

#include "operators/paths/light/film_splats.h"
#include "operators/render/from_paths/tally.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace neumann {

struct PixelShare {
    std::uint32_t pixel, quantity;
    Rgb value;
};

// The pixel of the crop in which a position lies, or the nearest one.
inline std::uint32_t pixel_at(const Film& film, const Vec2& position) {
    const int x = std::clamp(static_cast<int>(std::floor(position.x)) - film.crop_x, 0, film.crop_width - 1),
              y = std::clamp(static_cast<int>(std::floor(position.y)) - film.crop_y, 0, film.crop_height - 1);
    return static_cast<std::uint32_t>(y * film.crop_width + x);
}

// Adds a contribution to each pixel, times its filter. If it is not finite, it is recorded and left out.
inline void spread(const Film& film, const Vec2& position, std::size_t quantity, const Rgb& value, const SampleName& name,
                   std::vector<PixelShare>& shares, Tally& tally) {
    const SamplePlace place{pixel_at(film, position), name};
    if (!is_finite(value)) [[unlikely]] {
        tally.keep({static_cast<int>(quantity), place});
        return;
    }
    double largest = 0.0;
    for_pixels_reached(film, position, [&](std::uint32_t pixel, double weight) {
        largest = std::max(largest, std::abs(weight));
        shares.push_back({pixel, static_cast<std::uint32_t>(quantity), value * weight});
    });
    tally.largest[quantity].add(max_component(value) * largest, place);
}

}  // namespace neumann
