#include "operators/statistics/reduced_picture.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// `bounds` divides the mean once more by the number of pixels: it is the effect of one sample more or less.
enum class Add { values, squares, bounds };

Image box_means(const Image& picture, int factor, Add add) {
    if (picture.pixels.empty()) return {};
    Image out((picture.width + factor - 1) / factor, (picture.height + factor - 1) / factor);
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
            const int right = std::min(picture.width, (x + 1) * factor), low = std::min(picture.height, (y + 1) * factor);
            Rgb sum(0.0);
            for (int v = y * factor; v < low; ++v)
                for (int u = x * factor; u < right; ++u) {
                    const Rgb& p = picture.at(u, v);
                    sum += add == Add::squares ? p * p : p;
                }
            const double n = static_cast<double>((right - x * factor) * (low - y * factor));
            out.at(x, y) = (add == Add::squares ? glm::sqrt(sum) : sum) / (add == Add::bounds ? n * n : n);
        }
    }
    return out;
}

}  // namespace

PixelEstimate reduced(const PixelEstimate& picture, int factor) {
    if (factor == 1) return picture;
    PixelEstimate out = picture;
    out.mean = box_means(picture.mean, factor, Add::values);
    out.standard_error = box_means(picture.standard_error, factor, picture.pixels_are_independent ? Add::squares : Add::values);
    out.least_error = box_means(picture.least_error, factor, Add::bounds);
    out.discretisation = box_means(picture.discretisation, factor, Add::values);
    return out;
}

}  // namespace neumann
