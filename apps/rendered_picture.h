// A picture that a render wrote, with what its file says of its error.
#pragma once

#include "core/image/image.h"

#include <optional>
#include <string>

namespace neumann {

struct RenderedPicture {
    Estimate picture;  // its degrees of freedom are 0 where the file does not say them
    std::optional<double> degrees_of_freedom;
    bool infinite_variance = false;  // so that its standard errors give no interval

    bool has_error() const { return !picture.standard_error.pixels.empty(); }
};

// Throws InputError as read_exr().
RenderedPicture read_rendered_picture(const std::string& path);

}  // namespace neumann
