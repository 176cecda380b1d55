#include "core/emitter/slide.h"

#include <algorithm>
#include <cmath>

namespace neumann {

Slide::Slide(Image image, bool interpolated, Wrap wrap)
    : image_(std::make_shared<const Image>(std::move(image))), interpolated_(interpolated), wrap_(wrap) {
    for (const Rgb& c : image_->pixels) {
        mean_ += mean_component(c) / static_cast<double>(image_->pixels.size());
        is_grey_ = is_grey_ && neumann::is_grey(c);
    }
}

int Slide::wrapped(double index, int size) const {
    if (wrap_ == Wrap::clamp) return static_cast<int>(std::clamp(index, 0.0, size - 1.0));
    const double period = wrap_ == Wrap::mirror ? 2.0 * size : size;
    const int i = static_cast<int>(index - std::floor(index / period) * period);
    return i < size ? i : 2 * size - 1 - i;
}

Rgb Slide::at(const Vec2& uv) const {
    const Vec2 p = uv * Vec2(image_->width, image_->height);
    if (!interpolated_) return pixel(std::floor(p.x), std::floor(p.y));
    const double x = std::floor(p.x - 0.5), y = std::floor(p.y - 0.5), right = p.x - 0.5 - x, down = p.y - 0.5 - y;
    return glm::mix(glm::mix(pixel(x, y), pixel(x + 1.0, y), right), glm::mix(pixel(x, y + 1.0), pixel(x + 1.0, y + 1.0), right),
                    down);
}

}  // namespace neumann
