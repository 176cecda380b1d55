#include "operators/render/from_paths/whole_pictures.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <bit>

namespace neumann {

std::optional<MomentsNode> run_whole_pictures(std::uint64_t first, std::uint64_t count, std::size_t pixels, std::size_t quantities,
                                              const Watch& watch, std::vector<double> memory, const SamplePicture& sample) {
    const std::size_t stride = quantities * PixelMoments::doubles_per_quantity;
    std::vector<std::vector<double>> waiting(static_cast<std::size_t>(std::countr_zero(count)) + 1);
    std::vector<double> carry = std::move(memory);
    std::vector<Rgb> picture;
    const auto for_each_pixel = [&](const auto& f) {
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, pixels + 1, 256), [&](const auto& range) {
            for (std::size_t pixel = range.begin(); pixel < range.end(); ++pixel) f(pixel);
        });
    };
    for (std::uint64_t r = 0; r < count; ++r) {
        Watch of_picture = watch;
        of_picture.progress = [&](const RenderProgress& part) {
            watch.progress({.fraction = (static_cast<double>(r) + part.fraction) / static_cast<double>(count)});
        };
        picture.assign(pixels * quantities, Rgb(0.0));
        if (!sample(first + r, picture, of_picture)) return std::nullopt;
        std::vector<Rgb> mean(quantities, Rgb(0.0));
        for (std::size_t i = 0; i < picture.size(); ++i) mean[i % quantities] += picture[i];
        for (const Rgb& sum : mean) picture.push_back(sum / static_cast<double>(pixels));

        carry.resize((pixels + 1) * stride);
        const auto moments_of = [&](std::vector<double>& all, std::size_t pixel) {
            return std::span(all).subspan(pixel * stride, stride);
        };
        for_each_pixel([&](std::size_t pixel) {
            PixelMoments::set(moments_of(carry, pixel), std::span<const Rgb>(picture).subspan(pixel * quantities, quantities));
        });
        // Nodes of equal size are merged, like carries when 1 is added to a binary number.
        std::size_t level = 0;
        for (; r >> level & 1; ++level) {
            const auto n = static_cast<double>(std::uint64_t{1} << level);
            for_each_pixel(
                [&](std::size_t pixel) { PixelMoments::merge(moments_of(waiting[level], pixel), n, moments_of(carry, pixel), n); });
            std::swap(waiting[level], carry);
        }
        std::swap(waiting[level], carry);
    }
    return MomentsNode{first, count, std::move(waiting.back())};
}

}  // namespace neumann
