#include "apps/flip_book.h"

#include "core/image/image_io.h"
#include "core/image/resize.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace neumann {
namespace {

constexpr int longest_side = 512, longest_enlarged = 320, label_height = 30, label_size = 18;
constexpr double pixel_budget = 6e6;  // GIFs compress at about 1e6 pixels a second and core
constexpr double frames_per_second = 1.5;
constexpr std::uint8_t background = 34;

}  // namespace

std::string flip_book(std::span<const LabelledPicture> terms, std::span<const LabelledPicture> sums, double exposure,
                      const std::optional<std::string>& font) {
    if (terms.empty()) throw std::invalid_argument("flip_book: no pictures");
    std::vector<LabelledPicture> pages(terms.begin(), terms.end());
    pages.insert(pages.end(), sums.begin(), sums.end());

    const double width = pages.front().picture->width, height = pages.front().picture->height, longer = std::max(width, height);
    const double affordable = std::sqrt(pixel_budget / (width * height * static_cast<double>(pages.size())));
    double scale = std::min({longest_side / longer, affordable, std::max(1.0, std::floor(longest_enlarged / longer))});
    if (scale > 1.0) scale = std::floor(scale);
    const int frame_width = std::max(1, static_cast<int>(width * scale)),
              frame_height = std::max(1, static_cast<int>(height * scale));

    std::vector<DisplayImage> frames;
    for (const LabelledPicture& page : pages) {
        DisplayImage& frame = frames.emplace_back(frame_width, frame_height + label_height, background);
        frame.paste(to_display(resized(*page.picture, frame_width, frame_height), exposure), 0, 0);
        frame.paste(caption(page.label, frame_width, label_height, label_size, font, true, background), 0, frame_height);
    }
    return encode_gif(frames, frames_per_second);
}

}  // namespace neumann
