#include "operators/pictures/whole_pictures.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <bit>

namespace neumann {

namespace {

// So many replicates wait as pictures, a third as large as their moments, to be merged at once.
constexpr std::uint64_t most_together = 4;

template <class Function>
void for_each_pixel(std::size_t pixels, const Function& f) {
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, pixels, 256), [&](const auto& range) {
        for (std::size_t pixel = range.begin(); pixel < range.end(); ++pixel) f(pixel);
    });
}

std::span<double> node_of(std::vector<double>& all, std::size_t number, std::size_t stride) {
    return std::span(all).subspan(number * stride, stride);
}

// The moments of 2^k replicates at a pixel, from the pictures of their means.
void set_node(const std::vector<std::vector<Rgb>>& pictures, std::size_t pixel, std::size_t quantities, std::span<double> node) {
    std::vector<double> leaves(pictures.size() * node.size());
    const auto leaf = [&](std::size_t i) { return node_of(leaves, i, node.size()); };
    for (std::size_t i = 0; i < pictures.size(); ++i)
        PixelMoments::set(leaf(i), std::span(pictures[i]).subspan(pixel * quantities, quantities));
    for (std::size_t n = 1; n < pictures.size(); n *= 2)
        for (std::size_t i = 0; i < pictures.size(); i += 2 * n)
            PixelMoments::merge(leaf(i), static_cast<double>(n), leaf(i + n), static_cast<double>(n));
    std::ranges::copy(leaf(0), node.begin());
}

}  // namespace

std::optional<MomentsNode> run_whole_pictures(std::uint64_t first, std::uint64_t count, std::size_t pixels, std::size_t quantities,
                                              const Watch& watch, std::vector<double> memory, const SamplePicture& sample) {
    const std::size_t stride = quantities * PixelMoments::doubles_per_quantity;
    const std::uint64_t together = std::min(count, most_together);
    std::vector<std::vector<Rgb>> pictures(together);
    std::vector<std::vector<double>> waiting(static_cast<std::size_t>(std::countr_zero(count / together)) + 1);
    std::vector<double> carry = std::move(memory);
    for (std::uint64_t r = 0; r < count; ++r) {
        Watch of_picture = watch;
        of_picture.progress = [&](const RenderProgress& part) {
            watch.progress({.fraction = (static_cast<double>(r) + part.fraction) / static_cast<double>(count)});
        };
        std::vector<Rgb>& picture = pictures[r % together];
        picture.assign(pixels * quantities, Rgb(0.0));
        if (!sample(first + r, picture, of_picture)) return std::nullopt;
        std::vector<Rgb> mean(quantities, Rgb(0.0));
        for (std::size_t i = 0; i < picture.size(); ++i) mean[i % quantities] += picture[i];
        for (const Rgb& sum : mean) picture.push_back(sum / static_cast<double>(pixels));
        if ((r + 1) % together != 0) continue;

        carry.resize((pixels + 1) * stride);
        for_each_pixel(pixels + 1,
                       [&](std::size_t pixel) { set_node(pictures, pixel, quantities, node_of(carry, pixel, stride)); });
        // Nodes of equal size are merged, like carries when 1 is added to a binary number.
        std::size_t level = 0;
        for (; (r / together) >> level & 1; ++level) {
            const auto n = static_cast<double>(together << level);
            for_each_pixel(pixels + 1, [&](std::size_t pixel) {
                PixelMoments::merge(node_of(waiting[level], pixel, stride), n, node_of(carry, pixel, stride), n);
            });
            std::swap(waiting[level], carry);
        }
        std::swap(waiting[level], carry);
    }
    return MomentsNode{first, count, std::move(waiting.back())};
}

}  // namespace neumann
