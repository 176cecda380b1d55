// Films whose pixels all measure the same.
#pragma once

#include "core/sensor/sensor_options.h"

namespace neumann {

// A uniform random number pair for a sample at a position on a film with the box filter: its place within its pixel.
inline Vec2 place_in_pixel(const Vec2& position) { return position - glm::floor(position); }

// Chooses one of the pixels of a whole film at random.
class EvenFilm {
public:
    explicit EvenFilm(const Film& film) : size_(film.width, film.height) {}

    double pixels() const { return size_.x * size_.y; }
    // The middle of a pixel, and what is left of the two random numbers.
    struct Choice {
        Vec2 position, left;
    };
    Choice choose(const Vec2& u) const {
        const Vec2 at = u * size_, corner = glm::floor(at);
        return {corner + 0.5, at - corner};
    }

private:
    Vec2 size_;
};

}  // namespace neumann
