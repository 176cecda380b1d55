#include "core/image/module/write/encoders.h"

#include "core/image/picture_codec.h"

extern "C" const neumann::PictureWriter* neumann_picture_writer() {
    using namespace neumann::encoders;
    static const neumann::PictureWriter writer{encode_exr, write_exr_parts, encode_png, encode_gif,
                                               encode_pdf, find_label_font, text_width, draw_text};
    return &writer;
}
