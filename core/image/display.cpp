#include "core/image/display.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace neumann {
namespace {

// The sRGB transfer function, IEC 61966-2-1.
int srgb_byte(double linear) {
    const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    return static_cast<int>(std::lround(255.0 * encoded));
}

// The same by a table, since the power takes longer than everything else that is done with a pixel.
class SrgbTable {
public:
    SrgbTable() {
        for (int byte = 1; byte < 256; ++byte) {
            const double encoded = (byte - 0.5) / 255.0;
            double x = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
            while (srgb_byte(x) >= byte) x = std::nextafter(x, 0.0);
            while (srgb_byte(x) < byte) x = std::nextafter(x, 1.0);
            least_[static_cast<std::size_t>(byte)] = x;
        }
        for (int k = 0; k < steps; ++k)
            first_[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(srgb_byte(static_cast<double>(k) / steps));
    }

    std::uint8_t operator()(double linear) const {
        if (!(linear > 0.0)) return 0;
        if (linear >= 1.0) return 255;
        const std::uint8_t byte = first_[static_cast<std::size_t>(linear * steps)];
        return byte < 255 && linear >= least_[byte + 1u] ? static_cast<std::uint8_t>(byte + 1) : byte;
    }

private:
    // A step is 1/4096 long, and no byte is so short: the shortest is 1/(255 · 12.92).
    static constexpr int steps = 4096;
    std::array<std::uint8_t, steps> first_{};  // byte of k / steps
    std::array<double, 256> least_{};          // the least value of each byte
};

}  // namespace

void DisplayImage::paste(const DisplayImage& picture, int x, int y) {
    if (x < 0 || y < 0 || x + picture.width > width || y + picture.height > height) {
        throw std::out_of_range("DisplayImage::paste: the picture does not fit");
    }
    const auto row = 3 * static_cast<std::ptrdiff_t>(picture.width);
    for (int j = 0; j < picture.height; ++j) {
        const auto to = 3 * (static_cast<std::ptrdiff_t>(y + j) * width + x);
        std::copy_n(picture.bytes.begin() + j * row, row, bytes.begin() + to);
    }
}

double luminance(const Rgb& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

double exposure_for(const Image& sum, const Image& emission) {
    if (sum.width != emission.width || sum.height != emission.height) {
        throw std::invalid_argument("exposure_for: the pictures differ in size");
    }
    std::vector<double> lit, emitting;
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
        const double value = luminance(sum.pixels[i]);
        if (!(value > 0.0) || !std::isfinite(value)) continue;
        (is_black(emission.pixels[i]) ? lit : emitting).push_back(value);
    }
    std::vector<double>& voters = lit.empty() ? emitting : lit;
    if (voters.empty()) return 1.0;
    const auto rank = voters.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(voters.size() - 1));
    std::nth_element(voters.begin(), rank, voters.end());
    return 1.0 / *rank;
}

DisplayImage to_display(const Image& picture, double exposure) {
    static const SrgbTable srgb;
    DisplayImage out(picture.width, picture.height, 0);
    auto byte = out.bytes.begin();
    for (const Rgb& pixel : picture.pixels) {
        const Rgb shown = is_finite(pixel) ? pixel * exposure : Rgb(1.0, 0.0, 1.0);
        for (int c = 0; c < 3; ++c) *byte++ = srgb(shown[c]);
    }
    return out;
}

}  // namespace neumann
