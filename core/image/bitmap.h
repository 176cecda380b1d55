// A picture as a function of texture coordinates (Mitsuba's `bitmap`): (0, 0) is the corner of its first texel, u runs along its
// rows and v from row to row, over [0, 1]². Texel (x, y) has its centre at ((x + ½)/width, (y + ½)/height).
#pragma once

#include "core/base/vec.h"
#include "core/image/image.h"
#include "core/image/texels.h"

#include <array>
#include <memory>

namespace neumann {

class Bitmap {
public:
    enum class Filter { nearest, bilinear };
    // How the picture goes on beyond [0, 1]².
    enum class Wrap { repeat, mirror, clamp };

    // `raw`: values as they are in the file; otherwise whole numbers are decoded as sRGB.
    Bitmap(std::shared_ptr<const Texels> texels, Filter filter, Wrap wrap, bool raw);

    Rgb operator()(const Vec2& uv) const;
    // (∂/∂u, ∂/∂v) of the luminance; 0 between the steps of the nearest filter.
    Vec2 slope(const Vec2& uv) const;

    const Rgb& smallest() const { return smallest_; }
    const Rgb& largest() const { return largest_; }
    bool is_grey() const { return is_grey_; }
    int width() const { return texels_->width; }
    int height() const { return texels_->height; }
    // All texels, as a picture.
    Image image() const;

private:
    // The four texels around a point, as [row][column], and where it is between their centres.
    struct Around {
        Rgb texels[2][2];
        Vec2 at;
    };
    Around around(const Vec2& uv) const;
    Rgb texel(double x, double y) const;
    int wrapped(double i, int size) const;

    std::shared_ptr<const Texels> texels_;
    Filter filter_;
    Wrap wrap_;
    bool decode_;
    std::array<double, 256> value_of_byte_;
    Rgb smallest_, largest_;
    bool is_grey_ = true;
};

}  // namespace neumann
