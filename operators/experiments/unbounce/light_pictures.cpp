#include "operators/experiments/unbounce/light_pictures.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <cmath>

namespace neumann {

namespace {

bool is_finite(const Rgb& x) { return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z); }

bool is_finite(const Image& image) {
    for (const Rgb& pixel : image.pixels)
        if (!is_finite(pixel)) return false;
    return true;
}

Estimate checked(Estimate picture, const std::string& name, int width, int height) {
    const Image& mean = picture.mean;
    if (mean.width != width || mean.height != height)
        throw InputError(
            fmt::format("{}: {}×{} pixels, expected {}×{} as in the first picture", name, mean.width, mean.height, width, height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (!is_finite(mean.at(x, y)))
                throw InputError(
                    fmt::format("{}: pixel ({}, {}) is not finite; expected a picture without such pixels", name, x, y));
    // The errors of a single replicate are not known.
    if (!is_finite(picture.standard_error)) picture.standard_error = Image();
    return picture;
}

}  // namespace

Estimate checked_picture(const LightPictures& pictures, std::size_t light, int width, int height) {
    return checked(pictures.picture(light), pictures.names[light], width, height);
}

Estimate checked_direct(const LightPictures& pictures, std::size_t light, int width, int height) {
    return checked(pictures.direct(light), "the direct light of " + pictures.names[light], width, height);
}

}  // namespace neumann
