#include "core/emitter/slide.h"

#include <utility>

namespace neumann {

Slide::Slide(std::function<Rgb(const Vec2& uv)> f, int width, int height, bool is_grey)
    : function_(std::move(f)), aspect_(static_cast<double>(width) / height), is_grey_(is_grey) {
    for (int y = 0; y < height; ++y) {
        double row = 0.0;
        for (int x = 0; x < width; ++x) row += mean_component(at({(x + 0.5) / width, (y + 0.5) / height}));
        mean_ += row / width / height;
    }
}

Slide::Slide(const Rgb& constant) : Slide([constant](const Vec2&) { return constant; }, 1, 1, neumann::is_grey(constant)) {}

}  // namespace neumann
