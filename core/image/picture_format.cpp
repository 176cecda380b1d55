#include "core/image/picture_format.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace neumann {

namespace {

using namespace std::string_view_literals;

class PartReader {
public:
    PartReader(std::istream& file, std::string_view name) : name_(name), file_(file) {
        file_.seekg(0, std::ios::end);
        size_ = file_.tellg();
    }

    bool has(std::int64_t bytes) const { return at_ + bytes <= size_; }
    std::uint32_t number(bool big_endian) {
        std::array<unsigned char, 4> bytes{};
        read(reinterpret_cast<char*>(bytes.data()), bytes.size());
        if (big_endian) std::swap(bytes[0], bytes[3]), std::swap(bytes[1], bytes[2]);
        return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | std::uint32_t{bytes[3]} << 24;
    }
    // Reads up to a zero byte, or one byte more than OpenEXR's names may have.
    static constexpr std::size_t longest = 255;
    std::string text() {
        std::string result;
        for (char c = 0; has(1) && result.size() <= longest; result += c) {
            read(&c, 1);
            if (c == '\0') break;
        }
        return result;
    }
    void skip(std::int64_t bytes) {
        at_ += bytes;
        if (at_ > size_)
            throw InputError(
                fmt::format("{}: the picture is damaged: a part of it ends {} bytes beyond the file", name_, at_ - size_));
    }

private:
    void read(char* to, std::size_t bytes) {
        file_.seekg(at_);
        file_.read(to, static_cast<std::streamsize>(bytes));
        at_ += static_cast<std::int64_t>(bytes);
    }

    std::string_view name_;
    std::istream& file_;
    std::int64_t size_ = 0, at_ = 0;
};

// A PNG consists of chunks of length, type, data and check sum.
void walk_png(PartReader& file) {
    file.skip(8);
    while (file.has(12)) {
        const std::uint32_t length = file.number(true);
        file.skip(std::int64_t{length} + 8);
    }
}

// A header of OpenEXR consists of attributes, with name, type, length and data, and ends with an empty name. A file of
// several parts has their headers one after another, and then an empty one.
void walk_exr(PartReader& file) {
    constexpr std::uint32_t several_parts = 0x1000;
    file.skip(4);
    if (!file.has(4)) return;
    const bool several = (file.number(false) & several_parts) != 0;
    for (bool began = false; file.has(1);) {
        const std::string name = file.text();
        if (name.empty()) {
            if (!several || !began) return;
            began = false;
            continue;
        }
        began = true;
        if (name.size() > PartReader::longest || file.text().size() > PartReader::longest || !file.has(4)) return;
        const std::uint32_t length = file.number(false);
        file.skip(length);
    }
}

}  // namespace

std::string find_picture_format(std::istream& file, std::string_view name) {
    static constexpr std::pair<std::string_view, const char*> beginnings[] = {{"\x76\x2f\x31\x01"sv, "openexr"},
                                                                              {"\x89PNG"sv, "png"},
                                                                              {"\xff\xd8\xff"sv, "jpeg"},
                                                                              {"II*\0"sv, "tiff"},
                                                                              {"MM\0*"sv, "tiff"},
                                                                              {"II+\0"sv, "tiff"},
                                                                              {"MM\0+"sv, "tiff"},
                                                                              {"#?"sv, "hdr"},
                                                                              {"BM"sv, "bmp"},
                                                                              {"P1"sv, "pnm"},
                                                                              {"P2"sv, "pnm"},
                                                                              {"P3"sv, "pnm"},
                                                                              {"P4"sv, "pnm"},
                                                                              {"P5"sv, "pnm"},
                                                                              {"P6"sv, "pnm"},
                                                                              {"PF"sv, "pnm"},
                                                                              {"Pf"sv, "pnm"}};
    std::array<char, 4> first{};
    file.read(first.data(), first.size());
    file.clear();
    for (const auto& [beginning, format] : beginnings)
        if (std::string_view(first.data(), first.size()).starts_with(beginning)) return format;
    return name.ends_with(".tga") || name.ends_with(".TGA") ? "targa" : "";
}

void expect_parts_within_file(std::istream& file, std::string_view name, const std::string& format) {
    if (format != "png" && format != "openexr") return;
    PartReader parts(file, name);
    format == "png" ? walk_png(parts) : walk_exr(parts);
}

}  // namespace neumann
