#include "core/image/gif_frames.h"

#include <stdexcept>
#include <string_view>

namespace neumann {
namespace {

// GIF89a specification: https://www.w3.org/Graphics/GIF/spec-gif89a.txt
constexpr unsigned char extension = 0x21, graphic_control = 0xF9, image_descriptor = 0x2C, trailer = 0x3B;
constexpr std::size_t header_size = 13, size_at = 6, size_bytes = 4, descriptor_size = 10;

class Reader {
public:
    explicit Reader(std::string_view gif) : gif_(gif) {
        if (!gif.starts_with("GIF8")) throw std::invalid_argument("join_gif_frames: not a GIF");
    }

    unsigned char peek(std::size_t ahead = 0) const { return static_cast<unsigned char>(gif_.at(place_ + ahead)); }

    std::string_view take(std::size_t size) {
        if (place_ + size > gif_.size()) throw std::invalid_argument("join_gif_frames: a GIF ends early");
        const std::string_view taken = gif_.substr(place_, size);
        place_ += size;
        return taken;
    }

    // The colour table that the flags of a header or an image descriptor announce.
    static std::size_t table_size(unsigned char flags) {
        return (flags & 0x80U) != 0 ? std::size_t{3} << ((flags & 0x07U) + 1U) : std::size_t{0};
    }

    // Takes `fixed` bytes and the sub-blocks after them, up to and including the empty one.
    std::string_view take_block(std::size_t fixed) {
        std::size_t size = fixed;
        while (peek(size) != 0) size += 1U + peek(size);
        return take(size + 1);
    }

private:
    std::string_view gif_;
    std::size_t place_ = 0;
};

std::string header(std::string_view gif) {
    Reader reader(gif);
    return std::string(reader.take(header_size + Reader::table_size(reader.peek(header_size - 3))));
}

std::string first_frame(std::string_view gif, int delay) {
    Reader reader(gif);
    reader.take(header_size + Reader::table_size(reader.peek(header_size - 3)));
    std::string control;
    while (reader.peek() == extension) {
        const bool is_control = reader.peek(1) == graphic_control;
        const std::string_view block = reader.take_block(2);
        if (is_control) control = block;
    }
    if (reader.peek() != image_descriptor) throw std::invalid_argument("join_gif_frames: a GIF without a picture");
    if (control.empty()) control = std::string("\x21\xF9\x04\x04\0\0\0\0", 8);
    control[4] = static_cast<char>(delay & 0xFF);
    control[5] = static_cast<char>((delay >> 8) & 0xFF);
    const std::size_t table = Reader::table_size(reader.peek(descriptor_size - 1));
    constexpr std::size_t code_size_byte = 1;
    return control + std::string(reader.take_block(descriptor_size + table + code_size_byte));
}

}  // namespace

std::string join_gif_frames(std::span<const std::string> gifs, int delay) {
    if (gifs.empty()) throw std::invalid_argument("join_gif_frames: no frames");
    std::string joined = header(gifs.front());
    joined += std::string("\x21\xFF\x0BNETSCAPE2.0\x03\x01\0\0\0", 19);  // loops forever
    for (const std::string& gif : gifs) {
        if (header(gif).substr(size_at, size_bytes) != joined.substr(size_at, size_bytes))
            throw std::invalid_argument("join_gif_frames: frames of several sizes");
        joined += first_frame(gif, delay);
    }
    joined += static_cast<char>(trailer);
    return joined;
}

}  // namespace neumann
