#include "operators/experiments/study/differing_places.h"

#include "operators/statistics/metrics.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// Sums over all rectangles of a picture (Crow, Summed-Area Tables for Texture Mapping, 1984).
class SummedArea {
public:
    SummedArea(const std::vector<double>& values, int width, int height)
        : row_(static_cast<std::size_t>(width) + 1), sums_(row_ * (static_cast<std::size_t>(height) + 1)) {
        for (std::size_t y = 1; y <= static_cast<std::size_t>(height); ++y)
            for (std::size_t x = 1; x < row_; ++x)
                sums_[y * row_ + x] = values[(y - 1) * (row_ - 1) + x - 1] + sums_[(y - 1) * row_ + x] + sums_[y * row_ + x - 1] -
                                      sums_[(y - 1) * row_ + x - 1];
    }
    double operator()(const Crop& c) const {
        const auto at = [&](int x, int y) { return sums_[static_cast<std::size_t>(y) * row_ + static_cast<std::size_t>(x)]; };
        return at(c.x + c.width, c.y + c.height) - at(c.x, c.y + c.height) - at(c.x + c.width, c.y) + at(c.x, c.y);
    }

private:
    std::size_t row_;
    std::vector<double> sums_;
};

bool overlap(const Crop& a, const Crop& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

}  // namespace

Image cropped(const Image& picture, const Crop& crop) {
    if (picture.pixels.empty()) return {};
    Image result(crop.width, crop.height);
    for (int y = 0; y < crop.height; ++y)
        for (int x = 0; x < crop.width; ++x) result.at(x, y) = picture.at(crop.x + x, crop.y + y);
    return result;
}

Estimate cropped(const Estimate& picture, const Crop& crop) {
    return {cropped(picture.mean, crop), cropped(picture.standard_error, crop), picture.degrees_of_freedom,
            cropped(picture.discretisation, crop), picture.pixels_are_independent};
}

Image error_map(std::size_t repeats, const std::function<Image(std::size_t)>& picture, const Estimate& reference) {
    Image map(reference.mean.width, reference.mean.height);
    for (std::size_t j = 0; j < repeats; ++j) {
        const Image repeat = picture(j);
        for (std::size_t i = 0; i < map.pixels.size(); ++i) {
            const Rgb error = repeat.pixels[i] - reference.mean.pixels[i];
            map.pixels[i] += error * error / static_cast<double>(repeats);
        }
    }
    for (std::size_t i = 0; i < map.pixels.size(); ++i) {
        const Rgb noise = reference.standard_error.pixels.empty() ? Rgb(0.0) : reference.standard_error.pixels[i];
        map.pixels[i] = glm::sqrt(glm::max(map.pixels[i] - noise * noise, Rgb(0.0)));
    }
    return map;
}

std::vector<Crop> differing_places(const std::vector<Image>& error_maps, const Image& reference, std::size_t count) {
    const int width = reference.width, height = reference.height, shorter = std::min(width, height);
    const int side = std::min(std::max(shorter / 6, 8), shorter);
    const double size = PictureErrors({reference, {}}).reference_size(), least = metrics_epsilon * size * size;
    std::vector<double> spread(reference.pixels.size());
    for (std::size_t i = 0; i < spread.size(); ++i) {
        double low = 0.0, high = 0.0;
        for (std::size_t m = 0; m < error_maps.size(); ++m) {
            double q = 0.0;
            for (int c = 0; c < 3; ++c) {
                const double e = error_maps[m].pixels[i][c], r = reference.pixels[i][c];
                if (e != 0.0) q += e * e / (r * r + least);
            }
            q = std::sqrt(q);
            low = m == 0 ? q : std::min(low, q);
            high = std::max(high, q);
        }
        spread[i] = error_maps.size() > 1 ? high - low : high;
    }
    const SummedArea sum(spread, width, height);
    std::vector<Crop> found;
    while (found.size() < count) {
        Crop best;
        double most = 0.0;
        for (int y = 0; y + side <= height; ++y)
            for (int x = 0; x + side <= width; ++x) {
                const Crop crop{x, y, side, side};
                if (sum(crop) <= most || std::any_of(found.begin(), found.end(), [&](const Crop& c) { return overlap(c, crop); }))
                    continue;
                best = crop;
                most = sum(crop);
            }
        if (most == 0.0) break;
        found.push_back(best);
    }
    return found;
}

}  // namespace neumann
