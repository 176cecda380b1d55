// Which format a picture file has, and whether its header keeps what it promises: what the libraries that read pictures do not
// check before they ask for memory.
#pragma once

#include <istream>
#include <string>
#include <string_view>

namespace neumann {

// OpenImageIO's name of the format, by the first bytes, or by the file's name where there are none to tell (TGA); empty if it is
// none of OpenEXR, PNG, JPEG, TIFF, Radiance HDR, PNM, PFM, BMP or TGA. Left to itself OpenImageIO asks all readers it has, of
// which some abort the program over bytes that are not theirs.
std::string find_picture_format(std::istream& file, std::string_view name);

// Throws InputError, beginning with the name, where a chunk of a PNG or an attribute of an OpenEXR file ends beyond the file:
// libpng and OpenEXR set aside as much memory as it says it is long, up to 2 GiB, before they look whether there is so much.
void expect_parts_within_file(std::istream& file, std::string_view name, const std::string& format);

}  // namespace neumann
