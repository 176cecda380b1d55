#include "core/image/resize.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

namespace neumann {
namespace {

// The old pixels that a new one covers along an axis, from `first` on, with weights that add up to 1.
struct Cover {
    int first = 0;
    std::vector<double> weights;
};

std::vector<Cover> covers(int from, int to) {
    std::vector<Cover> out(static_cast<std::size_t>(to));
    for (int i = 0; i < to; ++i) {
        // Positions are in units of 1/to old pixels, so that all edges are whole numbers.
        const long begin = static_cast<long>(i) * from, end = begin + from;
        Cover& cover = out[static_cast<std::size_t>(i)];
        cover.first = static_cast<int>(begin / to);
        for (long old = cover.first; old * to < end; ++old) {
            const long overlap = std::min(end, (old + 1) * to) - std::max(begin, old * to);
            cover.weights.push_back(static_cast<double>(overlap) / from);
        }
    }
    return out;
}

}  // namespace

Image resized(const Image& picture, int width, int height) {
    if (picture.pixels.empty() || width < 1 || height < 1) throw std::invalid_argument("resized: an empty picture");
    if (width == picture.width && height == picture.height) return picture;
    const std::vector<Cover> columns = covers(picture.width, width), rows = covers(picture.height, height);
    Image out(width, height);
    tbb::parallel_for(0, height, [&](int y) {
        const Cover& row = rows[static_cast<std::size_t>(y)];
        std::vector<Rgb> line(static_cast<std::size_t>(picture.width), Rgb(0.0));
        for (std::size_t j = 0; j < row.weights.size(); ++j) {
            const Rgb* old = &picture.at(0, row.first + static_cast<int>(j));
            for (std::size_t x = 0; x < line.size(); ++x) line[x] += row.weights[j] * old[x];
        }
        for (int x = 0; x < width; ++x) {
            const Cover& column = columns[static_cast<std::size_t>(x)];
            const Rgb* old = &line[static_cast<std::size_t>(column.first)];
            for (std::size_t i = 0; i < column.weights.size(); ++i) out.at(x, y) += column.weights[i] * old[i];
        }
    });
    return out;
}

DisplayImage enlarged(const DisplayImage& picture, int factor) {
    DisplayImage out(picture.width * factor, picture.height * factor, 0);
    auto to = out.bytes.begin();
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) {
            const auto from = 3 * (static_cast<std::ptrdiff_t>(y / factor) * picture.width + x / factor);
            to = std::copy_n(picture.bytes.begin() + from, 3, to);
        }
    return out;
}

}  // namespace neumann
