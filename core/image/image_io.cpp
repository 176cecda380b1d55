#include "core/image/image_io.h"

#include "core/base/error.h"
#include "core/image/module/picture_codec.h"

#include <dlfcn.h>

namespace neumann {

namespace {

// OpenImageIO brings 260 libraries along, 0.3 s: who reads and writes no pictures is not to wait for them.
const PictureCodec& codec() {
    static const PictureCodec& loaded = [&]() -> const PictureCodec& {
        void* const library = dlopen(NEUMANN_PICTURES, RTLD_NOW | RTLD_LOCAL);
        if (library == nullptr)
            throw RunError(std::string("pictures can be neither read nor written, because part of neumann is missing: ") +
                           dlerror());
        const auto offer = reinterpret_cast<decltype(&neumann_picture_codec)>(dlsym(library, "neumann_picture_codec"));
        if (offer == nullptr) throw RunError(std::string("pictures can be neither read nor written: ") + dlerror());
        return *offer();
    }();
    return loaded;
}

}  // namespace

void expect_pictures() { codec(); }

std::string encode_exr(const PixelEstimate& picture, const Attributes& attributes) {
    return codec().encode_exr(picture, attributes);
}
std::string encode_png(const DisplayImage& picture) { return codec().encode_png(picture); }
std::string encode_gif(const DisplayImage& picture) { return codec().encode_gif(picture); }
PixelEstimate read_exr(const std::string& path, Attributes* attributes) { return codec().read_exr(path, attributes); }
Texels read_texels(const std::string& path) { return codec().read_texels(path); }
std::optional<std::string> find_label_font() { return codec().find_label_font(); }
int text_width(const std::string& text, int font_size, const std::string& font) {
    return codec().text_width(text, font_size, font);
}
void draw_text(DisplayImage& picture, int x, int y, const std::string& text, int font_size, const std::string& font,
               std::uint8_t grey) {
    codec().draw_text(picture, x, y, text, font_size, font, grey);
}

}  // namespace neumann
