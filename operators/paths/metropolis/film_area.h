// The part of the film from which light reaches the pixels of the crop, and positions there that are uniform by area.
#pragma once

#include "core/sensor/sensor_options.h"

#include <algorithm>

namespace neumann {

class FilmArea {
public:
    explicit FilmArea(const Film& film) {
        const double beyond = radius(film.filter) - 0.5;
        const auto bounds = [&](int crop, int size, int whole) {
            const double low = crop - beyond, high = crop + size + beyond;
            return film.sample_border ? Vec2(low, high) : Vec2(std::max(low, 0.0), std::min(high, double(whole)));
        };
        const Vec2 x = bounds(film.crop_x, film.crop_width, film.width), y = bounds(film.crop_y, film.crop_height, film.height);
        from_ = {x[0], y[0]};
        size_ = {x[1] - x[0], y[1] - y[0]};
    }

    double pixels() const { return size_.x * size_.y; }
    Vec2 at(const Vec2& u) const { return from_ + u * size_; }
    // The inverse of at(); outside of [0, 1]² for positions outside.
    Vec2 place_of(const Vec2& position) const { return (position - from_) / size_; }
    bool holds(const Vec2& position) const {
        const Vec2 u = place_of(position);
        return u.x >= 0.0 && u.x < 1.0 && u.y >= 0.0 && u.y < 1.0;
    }

private:
    Vec2 from_, size_;
};

}  // namespace neumann
