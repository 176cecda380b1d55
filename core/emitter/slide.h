// A picture that a light throws: Mitsuba's `bitmap` in the unit square, its first row at v = 0.
#pragma once

#include "core/image/image.h"

#include <memory>

namespace neumann {

class Slide {
public:
    enum class Wrap { repeat, mirror, clamp };

    // `image`: finite, not negative, not empty. `interpolated`: bilinear between the pixels' middles, or else the nearest pixel.
    explicit Slide(Image image, bool interpolated = true, Wrap wrap = Wrap::repeat);

    Rgb at(const Vec2& uv) const;
    double mean() const { return mean_; }  // of all pixels and channels
    double aspect() const { return static_cast<double>(image_->width) / image_->height; }
    bool is_grey() const { return is_grey_; }

private:
    int wrapped(double index, int size) const;
    const Rgb& pixel(double x, double y) const { return image_->at(wrapped(x, image_->width), wrapped(y, image_->height)); }

    std::shared_ptr<const Image> image_;
    bool interpolated_;
    Wrap wrap_;
    double mean_ = 0.0;
    bool is_grey_ = true;
};

}  // namespace neumann
