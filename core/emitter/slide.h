// The picture that a light projects: a function on the unit square, with (0, 0) the corner of its first pixel (Mitsuba's textures
// in lights).
#pragma once

#include "core/base/vec.h"

#include <functional>

namespace neumann {

class Slide {
public:
    // `f` must not be negative. `width` and `height` are in pixels; they give the aspect ratio, and the mean is over
    // the pixels' centres.
    Slide(std::function<Rgb(const Vec2& uv)> f, int width, int height, bool is_grey);
    explicit Slide(const Rgb& constant);

    Rgb at(const Vec2& uv) const { return function_(uv); }
    double mean() const { return mean_; }  // over all pixels' centres and channels
    double aspect() const { return aspect_; }
    bool is_grey() const { return is_grey_; }

private:
    std::function<Rgb(const Vec2& uv)> function_;
    double mean_ = 0.0, aspect_;
    bool is_grey_;
};

}  // namespace neumann
