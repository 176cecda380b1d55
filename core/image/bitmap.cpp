#include "core/image/bitmap.h"

#include "core/image/colour/spectrum_to_rgb.h"
#include "core/image/colour/srgb_bytes.h"
#include "core/image/display.h"

#include <algorithm>
#include <limits>

namespace neumann {

Bitmap::Bitmap(std::shared_ptr<const Texels> texels, Filter filter, Wrap wrap, bool raw)
    : texels_(std::move(texels)),
      filter_(filter),
      wrap_(wrap),
      decode_(!raw && texels_->is_encoded),
      smallest_(std::numeric_limits<double>::infinity()),
      largest_(-std::numeric_limits<double>::infinity()) {
    if (decode_)
        value_of_byte_ = decoded_srgb_bytes();
    else
        for (std::size_t i = 0; i < value_of_byte_.size(); ++i) value_of_byte_[i] = static_cast<double>(i) / 255.0;
    for (int y = 0; y < texels_->height; ++y)
        for (int x = 0; x < texels_->width; ++x) {
            const Rgb c = texel(x, y);
            smallest_ = glm::min(smallest_, c);
            largest_ = glm::max(largest_, c);
            is_grey_ = is_grey_ && neumann::is_grey(c);
        }
}

int Bitmap::wrapped(double i, int size) const {
    const double last = size - 1.0;
    const double period = wrap_ == Wrap::clamp ? 0.0 : std::floor(i / size), rest = i - period * size;
    const double inside = rest > 0.0 ? std::min(rest, last) : 0.0;
    const bool backwards = wrap_ == Wrap::mirror && std::fmod(period, 2.0) != 0.0;
    return static_cast<int>(backwards ? last - inside : inside);
}

Rgb Bitmap::texel(double x, double y) const {
    const std::size_t i = texels_->index(wrapped(x, texels_->width), wrapped(y, texels_->height));
    const auto value = [&](std::size_t channel) {
        if (!texels_->bytes.empty()) return value_of_byte_[texels_->bytes[i + channel]];
        const double v = texels_->values[i + channel];
        return decode_ ? srgb_decode(v) : v;
    };
    return texels_->channels == 1 ? Rgb(value(0)) : Rgb(value(0), value(1), value(2));
}

Image Bitmap::image() const {
    Image all(width(), height());
    for (int y = 0; y < height(); ++y)
        for (int x = 0; x < width(); ++x) all.at(x, y) = texel(x, y);
    return all;
}

Bitmap::Around Bitmap::around(const Vec2& uv) const {
    const Vec2 p = uv * Vec2(texels_->width, texels_->height) - 0.5, low = glm::floor(p);
    return {{{texel(low.x, low.y), texel(low.x + 1.0, low.y)}, {texel(low.x, low.y + 1.0), texel(low.x + 1.0, low.y + 1.0)}},
            p - low};
}

Rgb Bitmap::operator()(const Vec2& uv) const {
    if (filter_ == Filter::nearest) {
        const Vec2 p = glm::floor(uv * Vec2(texels_->width, texels_->height));
        return texel(p.x, p.y);
    }
    // Written so that texels that are alike give their value without rounding.
    const auto [texels, at] = around(uv);
    const Rgb low = texels[0][0] + (texels[0][1] - texels[0][0]) * at.x, high = texels[1][0] + (texels[1][1] - texels[1][0]) * at.x;
    return low + (high - low) * at.y;
}

Vec2 Bitmap::slope(const Vec2& uv) const {
    if (filter_ == Filter::nearest) return Vec2(0.0);
    const auto [texels, at] = around(uv);
    const Rgb along_u = (texels[0][1] - texels[0][0]) * (1.0 - at.y) + (texels[1][1] - texels[1][0]) * at.y;
    const Rgb along_v = (texels[1][0] - texels[0][0]) * (1.0 - at.x) + (texels[1][1] - texels[0][1]) * at.x;
    return Vec2(luminance(along_u), luminance(along_v)) * Vec2(texels_->width, texels_->height);
}

}  // namespace neumann
