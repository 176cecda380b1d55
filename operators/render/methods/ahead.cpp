#include "operators/render/methods/ahead.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

Film small_film(const Film& film, int most) {
    const double scale = std::min(1.0, static_cast<double>(most) / std::max(film.crop_width, film.crop_height));
    const auto scaled = [&](int size) { return std::max(1, static_cast<int>(std::lround(size * scale))); };
    Film small = film;
    small.width = scaled(film.width);
    small.height = scaled(film.height);
    small.crop_width = std::min(scaled(film.crop_width), small.width);
    small.crop_height = std::min(scaled(film.crop_height), small.height);
    small.crop_x = std::min(static_cast<int>(film.crop_x * scale), small.width - small.crop_width);
    small.crop_y = std::min(static_cast<int>(film.crop_y * scale), small.height - small.crop_height);
    return small;
}

double expected_rays(const Goal& goal, const Film& film, int bounces) {
    constexpr double a_second = 1e7;
    double rays = std::numeric_limits<double>::infinity();
    if (goal.samples)
        rays = static_cast<double>(*goal.samples) * film.crop_width * film.crop_height * rays_of_bounce * (bounces + 1.0);
    if (goal.seconds) rays = std::min(rays, *goal.seconds * a_second);
    return rays;
}

}  // namespace neumann
