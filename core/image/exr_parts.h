// OpenEXR files of several parts, one a picture.
#pragma once

#include "core/image/image_io.h"

#include <functional>
#include <string>

namespace neumann {

struct ExrPart {
    std::string name;  // of its own
    PixelEstimate picture;
    Attributes attributes = {};
};

// Each part has the header and the channels that encode_exr() gives its picture, called NAME.Combined.R, NAME.stderr.R and so on.
// All have one size. part(i) is asked for twice for every i, and has to be the same: the headers come first, and not all pictures
// need to be in memory at once.
std::string encode_exr_parts(std::size_t count, const std::function<ExrPart(std::size_t)>& part);

}  // namespace neumann
