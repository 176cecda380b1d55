// Draws text on pictures, by FreeType.
#include "core/image/module/write/encoders.h"

#include "core/base/error.h"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <boost/regex/pending/unicode_iterator.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

namespace neumann::encoders {

namespace {

// The characters of a text in UTF-8; of any other text, such as an old file name, its bytes.
std::vector<FT_ULong> characters(const std::string& text) {
    using Iterator = boost::u8_to_u32_iterator<std::string::const_iterator>;
    try {
        return {Iterator(text.begin(), text.begin(), text.end()), Iterator(text.end(), text.begin(), text.end())};
    } catch (const std::out_of_range&) {
        return {reinterpret_cast<const unsigned char*>(text.data()),
                reinterpret_cast<const unsigned char*>(text.data()) + text.size()};
    }
}

// An open font file, which FreeType uses for one thread at a time.
class Font {
public:
    explicit Font(const std::string& path) {
        if (FT_Init_FreeType(&library_) != 0) library_ = nullptr;
        if (library_ != nullptr && FT_New_Face(library_, path.c_str(), 0, &face_) != 0) face_ = nullptr;
    }
    ~Font() { FT_Done_FreeType(library_); }
    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;

    bool is_there() const { return face_ != nullptr; }

    // Calls what(glyph, x) for each character, drawn beside the ones before; its advance begins at x.
    template <class Function>
    void for_glyphs(const std::string& text, int size, const Function& what) {
        const std::scoped_lock lock(one_at_a_time_);
        if (!is_there() || FT_Set_Pixel_Sizes(face_, static_cast<FT_UInt>(size), 0) != 0) return;
        int x = 0;
        for (const FT_ULong c : characters(text)) {
            if (FT_Load_Char(face_, c, FT_LOAD_RENDER) != 0) continue;
            what(*face_->glyph, x);
            x += static_cast<int>(face_->glyph->advance.x >> 6);
        }
    }

private:
    FT_Library library_ = nullptr;
    FT_Face face_ = nullptr;
    std::mutex one_at_a_time_;
};

Font& opened(const std::string& path) {
    static std::mutex one_at_a_time;
    static std::map<std::string, std::unique_ptr<Font>> fonts;
    const std::scoped_lock lock(one_at_a_time);
    std::unique_ptr<Font>& font = fonts[path];
    if (!font) font = std::make_unique<Font>(path);
    return *font;
}

}  // namespace

std::optional<std::string> find_label_font() {
    // These are the paths of Debian and Ubuntu, Fedora, and Arch.
    for (const char* const path : {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                   "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf"})
        if (opened(path).is_there()) return path;
    return std::nullopt;
}

int text_width(const std::string& text, int font_size, const std::string& font) {
    int begin = std::numeric_limits<int>::max(), end = std::numeric_limits<int>::min();
    opened(font).for_glyphs(text, font_size, [&](const FT_GlyphSlotRec& glyph, int x) {
        begin = std::min(begin, x + glyph.bitmap_left);
        end = std::max(end, x + glyph.bitmap_left + static_cast<int>(glyph.bitmap.width) + 1);
    });
    return std::max(0, end - begin);
}

void draw_text(DisplayImage& picture, int x, int y, const std::string& text, int font_size, const std::string& font,
               std::uint8_t grey) {
    if (!opened(font).is_there()) throw RunError(fmt::format("FreeType cannot draw text with {}", font));
    opened(font).for_glyphs(text, font_size, [&](const FT_GlyphSlotRec& glyph, int advance) {
        const FT_Bitmap& bitmap = glyph.bitmap;
        for (int row = 0; row < static_cast<int>(bitmap.rows); ++row)
            for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
                const int to_x = x + advance + glyph.bitmap_left + column, to_y = y - glyph.bitmap_top + row;
                if (to_x < 0 || to_y < 0 || to_x >= picture.width || to_y >= picture.height) continue;
                const int covered = bitmap.buffer[row * bitmap.pitch + column];
                std::uint8_t* const to = picture.bytes.data() + 3 * (static_cast<std::ptrdiff_t>(to_y) * picture.width + to_x);
                for (int c = 0; c < 3; ++c)
                    to[c] = static_cast<std::uint8_t>((covered * grey + (255 - covered) * to[c] + 127) / 255);
            }
    });
}

}  // namespace neumann::encoders
