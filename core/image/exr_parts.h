// OpenEXR files of several parts, one a picture.
#pragma once

#include "core/image/image_io.h"

#include <filesystem>
#include <functional>
#include <string>

namespace neumann {

struct ExrPart {
    std::string name;  // name of the part
    PixelEstimate picture;
    Attributes attributes = {};
};

// Writes parts with the header and the channels that encode_exr() gives a picture, called NAME.Combined.R, NAME.stderr.R and so on.
// All have one size. part(i) is called twice for every i and must return the same: the headers come first, and neither the pictures
// nor the file need to be in memory at once. Throws std::system_error if the file cannot be written.
void write_exr_parts(const std::filesystem::path& path, std::size_t count, const std::function<ExrPart(std::size_t)>& part);

}  // namespace neumann
