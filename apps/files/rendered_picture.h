// A picture that a render wrote, with what its file says of its error.
#pragma once

#include "core/image/image_io.h"
#include "core/image/pixel_estimate.h"
#include "operators/statistics/picture_statistics.h"

#include <optional>
#include <string>

namespace neumann {

struct RenderedPicture {
    PixelEstimate picture;  // its degrees of freedom are 0 where the file does not say them
    std::optional<double> degrees_of_freedom;
    std::optional<PictureMeans> means;  // where the file holds them
    bool infinite_variance = false;     // so that its standard errors give no interval

    bool has_error() const { return !picture.standard_error.pixels.empty(); }
};

// What a header says of a picture's means: neumann:mean, neumann:mean_stderr and neumann:mean_degrees_of_freedom over pixels and
// channels, and with .R, .G and .B behind it of a channel.
Attributes mean_attributes(const PictureMeans& means);

// Throws InputError as read_exr().
RenderedPicture read_rendered_picture(const std::string& path);

}  // namespace neumann
