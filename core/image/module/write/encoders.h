// Writes pictures, text on pictures, and drawings: functions of image_io.h and drawing.h, each by the library of its format. These
// libraries load in some milliseconds, unlike OpenImageIO.
#pragma once

#include "core/image/drawing.h"
#include "core/image/exr_parts.h"
#include "core/image/image_io.h"

namespace neumann::encoders {

std::string encode_exr(const PixelEstimate& picture, const Attributes& attributes);
void write_exr_parts(const std::filesystem::path& path, std::size_t count, const std::function<ExrPart(std::size_t)>& part);
std::string encode_png(const DisplayImage& picture, const std::string& comment);
std::string encode_gif(const DisplayImage& picture);
std::string encode_pdf(const Drawing& drawing);
std::optional<std::string> find_label_font();
int text_width(const std::string& text, int font_size, const std::string& font);
void draw_text(DisplayImage& picture, int x, int y, const std::string& text, int font_size, const std::string& font,
               std::uint8_t grey);

}  // namespace neumann::encoders
