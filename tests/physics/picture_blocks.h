// Pictures in blocks of pixels, replicate by replicate, with their errors and their bias.
#pragma once

#include "operators/render/from_paths/picture_sampler.h"
#include "operators/render/methods/prepared.h"
#include "operators/render/methods/sampling.h"
#include "operators/render/report/picture_bias.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace neumann::physics {

// Means over blocks of pixels and, as one block more, over the whole picture, of each channel and quantity, replicate by replicate;
// the replicates are added to `pixels`, too, if it is given.
class Blocks {
public:
    Blocks(const Scene& scene, const SamplingSettings& settings, int block, std::uint64_t replicates,
           SeriesMoments* pixels = nullptr)
        : terms_(settings.pictures()), replicates_(replicates), radii_(settings.method->two_radii()) {
        const PictureSampler sampler(scene, settings);
        const std::size_t Q = settings.quantities();
        const auto size = static_cast<std::size_t>(block);
        width_ = static_cast<std::size_t>(sampler.width());
        size_ = size;
        if (Q > terms_) differences_.assign(terms_, Image(sampler.width(), sampler.height()));
        blocks_ = width_ / size * (static_cast<std::size_t>(sampler.height()) / size);
        quantities_ = Q;
        Tally tally(Q);
        for (std::uint64_t r = 0; r < replicates; ++r) {
            const auto node = sampler.run(r, 1, tally).value();
            std::vector<double> means((blocks_ + 1) * Q * 3, 0.0);
            for (std::size_t pixel = 0; pixel < width_ * static_cast<std::size_t>(sampler.height()); ++pixel) {
                const std::size_t b = block_of(pixel);
                for (std::size_t q = 0; q < Q; ++q)
                    for (std::size_t c = 0; c < 3; ++c) {
                        const double value = node.data[(pixel * Q + q) * PixelMoments::doubles_per_quantity + c];
                        means[(b * Q + q) * 3 + c] += value / static_cast<double>(size * size);
                        means[(blocks_ * Q + q) * 3 + c] += value / static_cast<double>(size * size * blocks_);
                        if (q >= terms_)
                            differences_[q - terms_].pixels[pixel][static_cast<int>(c)] += value / static_cast<double>(replicates);
                    }
            }
            all_.push_back(std::move(means));
            if (pixels) pixels->add(node);
        }
    }

    struct Value {
        double mean = 0.0, error = 0.0, bias = 0.0;
    };
    // Of the first n replicates.
    Value at(std::size_t block, std::size_t term, std::size_t channel, std::uint64_t n) const {
        const auto count = static_cast<double>(n);
        const auto mean = [&](std::size_t q) {
            double sum = 0.0;
            for (std::uint64_t r = 0; r < n; ++r) sum += all_[r][(block * quantities_ + q) * 3 + channel];
            return sum / count;
        };
        Value v{mean(term), 0.0, 0.0};
        for (std::uint64_t r = 0; r < n; ++r)
            v.error += std::pow(all_[r][(block * quantities_ + term) * 3 + channel] - v.mean, 2.0);
        v.error = std::sqrt(v.error / (count * (count - 1.0)));
        if (quantities_ > terms_) v.bias = std::abs(mean(terms_ + term)) / radii_->part_of_bias;
        return v;
    }
    // The mean over the block of the bias that a render of all replicates states.
    double stated_bias(std::size_t block, std::size_t term, std::size_t channel) const {
        const Image bias = neumann::stated_bias(*radii_, differences_.at(term));
        double sum = 0.0;
        std::size_t pixels = 0;
        for (std::size_t pixel = 0; pixel < bias.pixels.size(); ++pixel) {
            if (block != blocks_ && block != block_of(pixel)) continue;
            sum += bias.pixels[pixel][static_cast<int>(channel)];
            ++pixels;
        }
        return sum / static_cast<double>(pixels);
    }
    // Of a replicate, from the differences of successive ones of [begin, end), whose means are nearly the same.
    double variance(std::size_t block, std::size_t term, std::size_t channel, std::uint64_t begin, std::uint64_t end) const {
        const auto value = [&](std::uint64_t r) { return all_[r][(block * quantities_ + term) * 3 + channel]; };
        double squares = 0.0;
        for (std::uint64_t r = begin + 1; r < end; ++r) squares += std::pow(value(r) - value(r - 1), 2.0);
        return squares / (2.0 * static_cast<double>(end - begin - 1));
    }
    std::size_t blocks() const { return blocks_; }
    std::uint64_t replicates() const { return replicates_; }

private:
    std::size_t block_of(std::size_t pixel) const { return pixel / width_ / size_ * (width_ / size_) + pixel % width_ / size_; }

    std::size_t terms_, quantities_ = 0, width_ = 0, blocks_ = 0, size_ = 0;
    std::uint64_t replicates_;
    std::optional<TwoRadii> radii_;
    std::vector<Image> differences_;  // of terms between two radii, means over replicates
    std::vector<std::vector<double>> all_;
};

inline SamplingSettings settings_of(const Scene& scene, const Method& method, int bounces, std::uint64_t seed, double rest = 0.0) {
    SamplingSettings settings = sampling_settings(method, scene, {}, seed);
    settings.walk.bounces = bounces;
    settings.walk.rest_probability = rest;
    settings.replicate_size = is_biased(method) ? 4 : 16;
    Prepared prepared(seed);
    set_up(method, scene, bounces, 1e9, settings, prepared);
    return settings;
}

}  // namespace neumann::physics
