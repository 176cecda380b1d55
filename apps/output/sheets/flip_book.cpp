#include "apps/output/sheets/flip_book.h"

#include "core/image/gif_frames.h"
#include "core/image/image_io.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace neumann {
namespace {

constexpr int longest_side = 512, longest_enlarged = 320, flip_label_size = 18;
constexpr double seconds_to_spare = 0.6;
constexpr int hundredths_a_page = 67;

std::vector<std::string> compressed(std::span<const DisplayImage> frames) {
    std::vector<std::string> pages(frames.size());
    tbb::parallel_for(std::size_t{0}, frames.size(), [&](std::size_t i) { pages[i] = encode_gif(frames[i]); });
    return pages;
}

}  // namespace

double affordable_scale(int width, int height, std::size_t pictures, double seconds) {
    constexpr double pixels_a_second = 1e7;  // compressed per core
    return std::sqrt(seconds * pixels_a_second / (static_cast<double>(width) * height * static_cast<double>(pictures)));
}

FlipBook::FlipBook(std::vector<LabelledPicture> pictures, double exposure, const SheetStyle& style)
    : pictures_(std::move(pictures)) {
    if (pictures_.empty()) throw std::invalid_argument("FlipBook: no pictures");
    const Image& first = *pictures_.front().picture;
    const double longer = std::max(first.width, first.height);
    const double scale = scale_shown(
        first.width, first.height,
        std::min({longest_side / longer, affordable_scale(first.width, first.height, pictures_.size(), seconds_to_spare),
                  std::max(1.0, longest_enlarged / longer)}));
    const int width = std::max(1, static_cast<int>(first.width * scale)),
              height = std::max(1, static_cast<int>(first.height * scale));
    std::vector<DisplayImage> frames;
    for (const LabelledPicture& picture : pictures_)
        frames.push_back(with_label(picture, width, height, exposure, flip_label_size, style));
    pages_ = compressed(frames);
}

std::string FlipBook::gif(std::span<const LabelledPicture> chosen) const {
    std::vector<std::string> pages;
    for (const LabelledPicture& wanted : chosen) {
        const auto found = std::ranges::find(pictures_, wanted.picture, &LabelledPicture::picture);
        if (found == pictures_.end()) throw std::invalid_argument("FlipBook: not one of its pictures");
        pages.push_back(pages_[static_cast<std::size_t>(found - pictures_.begin())]);
    }
    return join_gif_frames(pages, hundredths_a_page);
}

std::string flip_book(std::span<const DisplayImage> frames) { return join_gif_frames(compressed(frames), hundredths_a_page); }

}  // namespace neumann
