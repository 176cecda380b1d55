#include "core/image/image_io.h"

#include "core/base/input_file.h"
#include "core/base/module.h"
#include "core/image/picture_codec.h"

namespace neumann {

namespace {

constexpr const char* without = "pictures can be neither read nor written";

// OpenImageIO takes 0.3 s to load with its 260 libraries, so it is loaded only when a picture is read.
const PictureReader& reader() {
    static const auto& loaded = offer_of_module<PictureReader>(NEUMANN_READER, "neumann_picture_reader", without);
    return loaded;
}

const PictureWriter& writer() {
    static const auto& loaded = offer_of_module<PictureWriter>(NEUMANN_WRITER, "neumann_picture_writer", without);
    return loaded;
}

}  // namespace

void expect_pictures() { writer(); }

std::string encode_exr(const PixelEstimate& picture, const Attributes& attributes) {
    return writer().encode_exr(picture, attributes);
}
void write_exr_parts(const std::filesystem::path& path, std::size_t count, const std::function<ExrPart(std::size_t)>& part) {
    writer().write_exr_parts(path, count, part);
}
std::string encode_png(const DisplayImage& picture, const std::string& comment) { return writer().encode_png(picture, comment); }
std::string encode_gif(const DisplayImage& picture) { return writer().encode_gif(picture); }
std::string encode_pdf(const Drawing& drawing) { return writer().encode_pdf(drawing); }
PixelEstimate read_exr(const std::string& path, Attributes* attributes) {
    expect_input(path, "a picture");
    return reader().read_exr(path, attributes);
}
Texels read_texels(const std::string& path) {
    expect_input(path, "a picture");
    return reader().read_texels(path);
}
Texels decode_texels(std::string_view bytes, const std::string& name) { return reader().decode_texels(bytes, name); }
std::vector<std::string> layers_in(const std::string& path) {
    expect_input(path, "a picture");
    return reader().layers_in(path);
}
Texels read_layer(const std::string& path, const std::string& name) {
    expect_input(path, "a picture");
    return reader().read_layer(path, name);
}
std::optional<std::string> find_label_font() { return writer().find_label_font(); }
int text_width(const std::string& text, int font_size, const std::string& font) {
    return writer().text_width(text, font_size, font);
}
void draw_text(DisplayImage& picture, int x, int y, const std::string& text, int font_size, const std::string& font,
               std::uint8_t grey) {
    writer().draw_text(picture, x, y, text, font_size, font, grey);
}

}  // namespace neumann
