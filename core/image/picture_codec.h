// The functions of image_io.h that the modules for pictures offer.
#pragma once

#include "core/image/drawing.h"
#include "core/image/exr_parts.h"
#include "core/image/image_io.h"

namespace neumann {

struct PictureReader {
    decltype(&neumann::read_exr) read_exr;
    decltype(&neumann::read_texels) read_texels;
    decltype(&neumann::decode_texels) decode_texels;
    decltype(&neumann::layers_in) layers_in;
    decltype(&neumann::read_layer) read_layer;
};

struct PictureWriter {
    decltype(&neumann::encode_exr) encode_exr;
    decltype(&neumann::write_exr_parts) write_exr_parts;
    decltype(&neumann::encode_png) encode_png;
    decltype(&neumann::encode_gif) encode_gif;
    decltype(&neumann::encode_pdf) encode_pdf;
    decltype(&neumann::find_label_font) find_label_font;
    decltype(&neumann::text_width) text_width;
    decltype(&neumann::draw_text) draw_text;
};

}  // namespace neumann

extern "C" const neumann::PictureReader* neumann_picture_reader();
extern "C" const neumann::PictureWriter* neumann_picture_writer();
