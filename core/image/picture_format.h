// Finds the format of a picture file, and checks sizes in its header that the libraries for pictures do not check
// before they ask for memory.
#pragma once

#include <istream>
#include <string>
#include <string_view>

namespace neumann {

// OpenImageIO's name of the format, by the first bytes, or by the file's name if no bytes identify the format (TGA);
// empty if it is none of OpenEXR, PNG, JPEG, TIFF, Radiance HDR, PNM, PFM, BMP or TGA. By itself OpenImageIO tries all
// readers it has, some of which abort the program over bytes that are not theirs.
std::string find_picture_format(std::istream& file, std::string_view name);

// Throws InputError, which begins with the name, if a chunk of a PNG or an attribute of an OpenEXR file ends beyond the file:
// libpng and OpenEXR allocate as much memory as its length says, up to 2 GiB, before they check that so much is there.
void expect_parts_within_file(std::istream& file, std::string_view name, const std::string& format);

}  // namespace neumann
