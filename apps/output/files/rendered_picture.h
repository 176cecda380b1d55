// A picture written by a render, with the errors that its file contains.
#pragma once

#include "core/image/image_io.h"
#include "core/image/pixel_estimate.h"
#include "operators/statistics/picture_statistics.h"

#include <optional>
#include <string>

namespace neumann {

struct RenderedPicture {
    PixelEstimate picture;  // its degrees of freedom are 0 if the file does not contain them
    std::optional<double> degrees_of_freedom;
    std::optional<PictureMeans> means;  // if the file contains them
    bool infinite_variance = false;     // if true, standard errors give no valid interval

    bool has_error() const { return !picture.standard_error.pixels.empty(); }
};

// The header attributes of a picture's means: neumann:mean, neumann:mean_stderr and neumann:mean_degrees_of_freedom
// over pixels and channels, and the same names followed by .R, .G and .B for each channel.
Attributes mean_attributes(const PictureMeans& means);

// Throws InputError as read_exr().
RenderedPicture read_rendered_picture(const std::string& path);

}  // namespace neumann
