// Writes GIF files of one picture, by giflib.
#include "core/image/module/write/encoders.h"

#include "core/base/error.h"
#include "core/image/indexed_image.h"

#include <gif_lib.h>

#include <fmt/format.h>
#include <bit>
#include <memory>

namespace neumann::encoders {

namespace {

struct Closed {
    void operator()(GifFileType* file) const { EGifCloseFile(file, nullptr); }
};
struct Freed {
    void operator()(ColorMapObject* map) const { GifFreeMapObject(map); }
};

int append(GifFileType* file, const GifByteType* bytes, int count) {
    static_cast<std::string*>(file->UserData)->append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
    return count;
}

}  // namespace

std::string encode_gif(const DisplayImage& picture) {
    IndexedImage image = with_few_colours(picture);
    const auto room = std::bit_ceil(std::max<std::size_t>(2, image.colours.size()));
    const std::unique_ptr<ColorMapObject, Freed> map(GifMakeMapObject(static_cast<int>(room), nullptr));
    std::string bytes;
    int error = 0;
    std::unique_ptr<GifFileType, Closed> file(EGifOpen(&bytes, append, &error));
    if (!map || !file) throw std::bad_alloc();
    for (std::size_t i = 0; i < image.colours.size(); ++i)
        map->Colors[i] = {image.colours[i][0], image.colours[i][1], image.colours[i][2]};
    EGifSetGifVersion(file.get(), true);
    constexpr int bits_a_channel = 8;
    bool good = EGifPutScreenDesc(file.get(), image.width, image.height, bits_a_channel, 0, nullptr) == GIF_OK &&
                EGifPutImageDesc(file.get(), 0, 0, image.width, image.height, false, map.get()) == GIF_OK;
    for (int y = 0; good && y < image.height; ++y)
        good = EGifPutLine(file.get(), image.pixels.data() + static_cast<std::ptrdiff_t>(y) * image.width, image.width) == GIF_OK;
    good = EGifCloseFile(file.release(), &error) == GIF_OK && good;
    if (!good) throw RunError(fmt::format("giflib cannot write a picture of {}×{}", image.width, image.height));
    return bytes;
}

}  // namespace neumann::encoders
