#include "core/image/indexed_image.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace neumann {
namespace {

// Colours that agree in the upper bits of each channel are counted, and looked up, together.
constexpr int cell_bits = 6, bits_below = 8 - cell_bits;
constexpr std::size_t cells = std::size_t{1} << (3 * cell_bits), most_colours = 256;

std::size_t cell_of(int r, int g, int b) {
    const auto upper = [](int value) { return static_cast<std::size_t>(value >> bits_below); };
    return (upper(r) << (2 * cell_bits)) | (upper(g) << cell_bits) | upper(b);
}

struct Cell {
    double count = 0.0;
    std::array<double, 3> mean{};
};

struct Box {
    std::size_t begin = 0, end = 0;
    double count = 0.0;
    std::array<double, 3> mean{};
    double error = 0.0;    // Σ count |colour − mean|²
    std::size_t axis = 0;  // along which `error` is largest
};

Box box_of(const std::vector<Cell>& all, std::size_t begin, std::size_t end) {
    Box box{begin, end};
    std::array<double, 3> sums{}, squares{};
    for (std::size_t i = begin; i < end; ++i) {
        box.count += all[i].count;
        for (std::size_t c = 0; c < 3; ++c) {
            sums[c] += all[i].count * all[i].mean[c];
            squares[c] += all[i].count * all[i].mean[c] * all[i].mean[c];
        }
    }
    double largest = -1.0;
    for (std::size_t c = 0; c < 3; ++c) {
        box.mean[c] = sums[c] / box.count;
        const double error = squares[c] - sums[c] * box.mean[c];
        box.error += error;
        if (error <= largest) continue;
        largest = error;
        box.axis = c;
    }
    return box;
}

std::vector<Cell> count_colours(const DisplayImage& picture) {
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> places(cells, none);
    std::vector<Cell> found;
    for (std::size_t i = 0; i < picture.bytes.size(); i += 3) {
        const std::uint8_t* const p = &picture.bytes[i];
        std::uint32_t& place = places[cell_of(p[0], p[1], p[2])];
        if (place == none) {
            place = static_cast<std::uint32_t>(found.size());
            found.emplace_back();
        }
        Cell& cell = found[place];
        cell.count += 1.0;
        for (std::size_t c = 0; c < 3; ++c) cell.mean[c] += p[c];
    }
    for (Cell& cell : found)
        for (double& value : cell.mean) value /= cell.count;
    return found;
}

// Finds the nearest of some colours. A result is for a whole cell, and is kept.
class NearestColour {
public:
    // `colours` must be sorted by green.
    explicit NearestColour(const std::vector<Colour>& colours) : colours_(colours), found_(cells, -1) {
        int k = 0;
        for (int green = 0; green < 256; ++green) {
            while (k + 1 < static_cast<int>(colours_.size()) && colours_[static_cast<std::size_t>(k)][1] < green) ++k;
            first_[static_cast<std::size_t>(green)] = k;
        }
    }

    std::uint8_t operator()(const std::array<int, 3>& colour) {
        std::int16_t& known = found_[cell_of(colour[0], colour[1], colour[2])];
        constexpr int half = 1 << (bits_below - 1), below = (1 << bits_below) - 1;
        if (known < 0) known = search({(colour[0] & ~below) | half, (colour[1] & ~below) | half, (colour[2] & ~below) | half});
        return static_cast<std::uint8_t>(known);
    }

private:
    // Searches outwards from the same green, until the difference in green alone exceeds the best.
    std::int16_t search(const std::array<int, 3>& wanted) const {
        int least = std::numeric_limits<int>::max(), best = 0;
        const auto try_one = [&](int k) {
            const Colour& colour = colours_[static_cast<std::size_t>(k)];
            const int r = colour[0] - wanted[0], g = colour[1] - wanted[1], b = colour[2] - wanted[2];
            const int distance = r * r + g * g + b * b;
            if (distance < least) {
                least = distance;
                best = k;
            }
            return g * g < least;
        };
        const int start = first_[static_cast<std::size_t>(wanted[1])];
        for (int k = start; k < static_cast<int>(colours_.size()) && try_one(k); ++k) {
        }
        for (int k = start - 1; k >= 0 && try_one(k); --k) {
        }
        return static_cast<std::int16_t>(best);
    }

    const std::vector<Colour>& colours_;
    std::array<int, 256> first_{};  // for each green, the first colour with as much of it
    std::vector<std::int16_t> found_;
};

}  // namespace

std::vector<Colour> choose_colours(const DisplayImage& picture) {
    std::vector<Cell> all = count_colours(picture);
    if (all.empty()) throw std::invalid_argument("choose_colours: an empty picture");
    std::vector<Box> boxes{box_of(all, 0, all.size())};
    while (boxes.size() < most_colours) {
        const auto worst = std::ranges::max_element(boxes, {}, &Box::error);
        const Box box = *worst;
        const auto at = [&](std::size_t i) { return all.begin() + static_cast<std::ptrdiff_t>(i); };
        const auto middle =
            std::partition(at(box.begin), at(box.end), [&](const Cell& cell) { return cell.mean[box.axis] < box.mean[box.axis]; });
        const auto cut = static_cast<std::size_t>(middle - all.begin());
        if (cut == box.begin || cut == box.end) {
            if (box.error <= 0.0) break;
            worst->error = 0.0;  // what is left is rounding
            continue;
        }
        *worst = box_of(all, box.begin, cut);
        boxes.push_back(box_of(all, cut, box.end));
    }
    std::vector<Colour> colours;
    for (const Box& box : boxes) {
        Colour& colour = colours.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) colour[c] = static_cast<std::uint8_t>(box.mean[c] + 0.5);
    }
    return colours;
}

// Floyd and Steinberg, An adaptive algorithm for spatial greyscale, 1976; rows run to and fro. A quarter of each error
// is dropped: with few colours errors would add up, until some pixel gets a colour that is nowhere around.
IndexedImage with_few_colours(const DisplayImage& picture) {
    IndexedImage out{picture.width, picture.height, choose_colours(picture), {}};
    std::ranges::sort(out.colours, {}, [](const Colour& colour) { return colour[1]; });
    NearestColour nearest(out.colours);
    const int width = picture.width;
    out.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(picture.height));
    using Error = std::array<int, 3>;  // in units of 1/64
    std::vector<Error> below(static_cast<std::size_t>(width) + 2);
    for (int y = 0; y < picture.height; ++y) {
        const int step = y % 2 == 0 ? 1 : -1;
        Error ahead{}, behind{}, under{};
        int x = step > 0 ? 0 : width - 1;
        for (int k = 0; k < width; ++k, x += step) {
            const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
            Error& from_above = below[static_cast<std::size_t>(x + 1)];
            Error& at_behind = below[static_cast<std::size_t>(x + 1 - step)];
            std::array<int, 3> wanted{};
            for (std::size_t c = 0; c < 3; ++c)
                wanted[c] = std::clamp(picture.bytes[3 * pixel + c] + ((ahead[c] + from_above[c] + 32) >> 6), 0, 255);
            const std::uint8_t index = nearest(wanted);
            out.pixels[pixel] = index;
            for (std::size_t c = 0; c < 3; ++c) {
                const int error = 3 * (wanted[c] - out.colours[index][c]);
                ahead[c] = 7 * error;
                at_behind[c] = behind[c] + 3 * error;
                behind[c] = under[c] + 5 * error;
                under[c] = error;
            }
        }
        below[static_cast<std::size_t>(x + 1 - step)] = behind;
    }
    return out;
}

}  // namespace neumann
