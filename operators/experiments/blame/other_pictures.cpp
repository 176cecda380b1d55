#include "operators/experiments/blame/other_pictures.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

namespace {

Image difference(const Image& a, const Image& b) {
    Image result = a;
    for (std::size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] -= b.pixels[i];
    return result;
}

std::optional<Image> difference(const std::optional<Image>& a, const std::optional<Image>& b) {
    if (!a || !b) return std::nullopt;
    return difference(*a, *b);
}

std::optional<Image> sum(const std::optional<Image>& a, const std::optional<Image>& b) {
    if (!a || !b) return std::nullopt;
    Image result = *a;
    for (std::size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] += b->pixels[i];
    return result;
}

}  // namespace

double mean_of(const Image& image) {
    double sum = 0.0;
    for (const Rgb& c : image.pixels) sum += mean_component(c);
    return sum / static_cast<double>(std::max<std::size_t>(image.pixels.size(), 1));
}

DepthPicture mean_of_two(int depth, const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height)
        throw InputError(
            fmt::format("the pictures of depth {} have {}×{} and {}×{} pixels", depth, a.width, a.height, b.width, b.height));
    constexpr int reach = 2;
    DepthPicture result{depth, a, Image(a.width, a.height), difference(a, b)};
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        result.mean.pixels[i] = (a.pixels[i] + b.pixels[i]) * 0.5;
        result.half_difference->pixels[i] *= 0.5;
    }
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            Rgb sum(0.0);
            int count = 0;
            for (int j = std::max(y - reach, 0); j <= std::min(y + reach, a.height - 1); ++j)
                for (int i = std::max(x - reach, 0); i <= std::min(x + reach, a.width - 1); ++i, ++count) {
                    const Rgb d = a.at(i, j) - b.at(i, j);
                    sum += d * d * 0.25;
                }
            result.variance->at(x, y) = sum / static_cast<double>(count);
        }
    return result;
}

const char* name_of(Counting counting) {
    switch (counting) {
        case Counting::bounces:
            return "bounces";
        case Counting::mitsuba:
            return "mitsuba";
        case Counting::pbrt:
            return "pbrt";
        default:
            return "cycles";
    }
}

int last_bounce(Counting counting, int depth) {
    return counting == Counting::mitsuba ? depth - 1 : counting == Counting::cycles ? depth + 1 : depth;
}

std::string to_string(const BounceRange& bounces) {
    if (bounces.first == bounces.last) return fmt::format("bounce {}", bounces.first);
    return fmt::format("bounces {} {} {}", bounces.first, bounces.last == bounces.first + 1 ? "and" : "to", bounces.last);
}

std::vector<OtherTerm> terms_of(std::vector<DepthPicture> pictures, Counting counting) {
    std::sort(pictures.begin(), pictures.end(), [](const DepthPicture& a, const DepthPicture& b) { return a.depth < b.depth; });
    std::vector<OtherTerm> terms;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const DepthPicture& p = pictures[i];
        if (i > 0 && p.depth == pictures[i - 1].depth) throw InputError(fmt::format("two pictures have the number {}", p.depth));
        if (i > 0 && (p.mean.width != pictures[0].mean.width || p.mean.height != pictures[0].mean.height))
            throw InputError(fmt::format("picture {} has {}×{} pixels and picture {} has {}×{}", p.depth, p.mean.width,
                                         p.mean.height, pictures[0].depth, pictures[0].mean.width, pictures[0].mean.height));
        const int last = last_bounce(counting, p.depth);
        if (last < 0)
            throw InputError(
                fmt::format("a picture with the depth limit {} holds no bounce as {} counts", p.depth, name_of(counting)));
        if (counting == Counting::bounces) {
            terms.push_back({{last, last}, p.mean, p.variance, p.half_difference});
        } else if (i == 0) {
            terms.push_back({{0, last}, p.mean, p.variance, p.half_difference});
        } else {
            const DepthPicture& before = pictures[i - 1];
            terms.push_back({{last_bounce(counting, before.depth) + 1, last},
                             difference(p.mean, before.mean),
                             sum(p.variance, before.variance),
                             difference(p.half_difference, before.half_difference)});
        }
    }
    return terms;
}

double misfit_of_means(const std::vector<DepthPicture>& pictures, Counting counting, const std::vector<double>& sums) {
    double misfit = 0.0;
    for (const DepthPicture& p : pictures) {
        const int last = last_bounce(counting, p.depth);
        const double expected = last < 0 ? 0.0 : sums[std::min(static_cast<std::size_t>(last), sums.size() - 1)],
                     found = mean_of(p.mean), both = expected + found;
        if (both > 0.0) misfit += std::abs(expected - found) / both;
    }
    return misfit / static_cast<double>(pictures.size());
}

Counting likely_counting(const std::vector<DepthPicture>& pictures, const std::vector<double>& sums) {
    return *std::min_element(std::begin(depth_countings), std::end(depth_countings), [&](Counting a, Counting b) {
        return misfit_of_means(pictures, a, sums) < misfit_of_means(pictures, b, sums);
    });
}

}  // namespace neumann
