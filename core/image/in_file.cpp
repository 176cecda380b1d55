#include "core/image/in_file.h"

namespace neumann {

namespace {

void round_to_floats(Image& image) {
    for (Rgb& p : image.pixels)
        for (int c = 0; c < 3; ++c) p[c] = static_cast<float>(p[c]);
}

}  // namespace

// A file holds the errors of pixels, and the spread if it differs.
PixelEstimate as_in_file(PixelEstimate picture) {
    if (!picture.least_error.pixels.empty()) {
        Image errors = picture.pixel_errors();
        picture.least_error = errors.pixels == picture.standard_error.pixels ? Image() : std::move(errors);
    }
    for (Image* image : {&picture.mean, &picture.standard_error, &picture.least_error, &picture.discretisation})
        round_to_floats(*image);
    return picture;
}

}  // namespace neumann
