// Picture files, and text on pictures. Files are encoded in memory, so the code that writes them to the disk sees every failure.
// All functions may be called from several threads at once.
#pragma once

#include "core/image/display.h"
#include "core/image/pixel_estimate.h"
#include "core/image/texels.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace neumann {

// Loads the module that writes pictures, which the functions otherwise load when first called. Throws RunError if it is missing.
void expect_pictures();

// The entries of an EXR header beside the picture: "neumann:bounce" and the like. Whole numbers beyond 32 bits, which
// OpenEXR does not have, are written as double if that is exact and as text otherwise.
using Attribute = std::variant<std::int64_t, double, std::string>;
using Attributes = std::map<std::string, Attribute>;

// An OpenEXR file: float32 channels R, G, B (`mean`), stderr.R, stderr.G, stderr.B (pixel_errors()), spread.R, …
// (`standard_error`) if these differ, and discretisation.R, …; those of an empty picture are left out. The pictures
// have one size, at least 1×1; otherwise throws std::invalid_argument.
std::string encode_exr(const PixelEstimate& picture, const Attributes& attributes = {});

// A PNG file with 8 bits a channel, and with a comment in UTF-8 unless that is empty.
std::string encode_png(const DisplayImage& picture, const std::string& comment = "");

// A GIF file of 256 colours of its own, dithered (indexed_image.h): a frame for join_gif_frames().
std::string encode_gif(const DisplayImage& picture);

// Reads a picture (OpenEXR, PNG, JPEG, TIFF, Radiance HDR, PNM, PFM, BMP, TGA) with the values in the file (8-bit ones scaled to
// 0..1, not linearised; NaN and infinity kept), and into `attributes`, if given, the numbers and texts of its header. Without
// stderr channels `standard_error` is empty (0×0), and so is `discretisation`; if there is a spread, `least_error` is the stderr.
// Throws InputError, which begins with the path: no such file, not a picture, damaged, no channels R, G, B.
PixelEstimate read_exr(const std::string& path, Attributes* attributes = nullptr);

// Reads a picture as a texture: channels R, G, B if there are any of these names, otherwise the first three, or the first if there
// are fewer. Throws InputError, which begins with the path: no such file, not a picture, damaged, a value that is not finite.
Texels read_texels(const std::string& path);

// The same for the bytes of a file, but with all its channels, up to four: grey, grey and alpha, RGB, or RGB and alpha,
// which is not multiplied into the colours. Errors begin with `name`.
Texels decode_texels(std::string_view bytes, const std::string& name);

// The layers of colour in a picture of any renderer: "ViewLayer.Combined" for channels ViewLayer.Combined.R, .G and .B,
// "" for R, G and B; also r, g, b, and red, green, blue. In a file of several parts their names come first, unless the
// channels begin with them. A channel that is alone in its part is grey. Throws InputError, which begins with the path,
// as read_texels() does, and if there is no layer.
std::vector<std::string> layers_in(const std::string& path);

// Reads one of these layers, with three channels or one.
Texels read_layer(const std::string& path, const std::string& name);

// The path of the font for labels (DejaVu Sans; Debian's fonts-dejavu-core), if it is installed and text can be drawn at all.
std::optional<std::string> find_label_font();

// The width of a text in pixels.
int text_width(const std::string& text, int font_size, const std::string& font);

// Draws ASCII text in a grey level, its baseline beginning at (x, y).
void draw_text(DisplayImage& picture, int x, int y, const std::string& text, int font_size, const std::string& font,
               std::uint8_t grey = 255);

}  // namespace neumann
