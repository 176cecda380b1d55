#include "operators/render/from_paths/mixed_sampler.h"

#include "operators/render/from_paths/film_shares.h"
#include "operators/render/from_paths/picture_sampler.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace neumann {

namespace {

constexpr std::uint64_t part_stream = 0x9e3779b97f4a7c15ULL;

}  // namespace

std::shared_ptr<const PathSampler> MixedPaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    return std::make_shared<const MixedSampler>(scene, settings, mixture_);
}

bool MixedPaths::is_bounded(const SamplingSettings& settings) const { return settings.walk.direct.direct == DirectLight::mis; }

bool MixedPaths::has_events() const {
    return std::ranges::all_of(mixture_->parts, [](const Mixture::Part& part) { return part.path_method->has_events(); });
}

bool MixedPaths::has_chains() const {
    return std::ranges::any_of(mixture_->parts, [](const Mixture::Part& part) { return part.path_method->has_chains(); });
}

SamplingSettings settings_of_part(const SamplingSettings& settings, const Mixture& mixture, std::size_t part) {
    const Mixture::Part& mixture_part = mixture.parts[part];
    SamplingSettings own = settings;
    own.method = mixture_part.path_method;
    own.allocation = mixture_part.allocation;
    own.walk.left_out = mixture_part.left_out;
    if (!mixture_part.allocation) own.replicate_size = Allocation::size_of(settings.replicate_size, mixture_part.exponent);
    own.seed = settings.seed ^ (part + 1) * part_stream;
    return own;
}

MixedSampler::MixedSampler(const Scene& scene, const SamplingSettings& settings, std::shared_ptr<const Mixture> mixture)
    : PathSampler(scene, settings),
      width_(static_cast<std::uint32_t>(scene.film.crop_width)),
      height_(static_cast<std::uint32_t>(scene.film.crop_height)),
      mixture_(std::move(mixture)) {
    for (std::size_t part = 0; part < mixture_->parts.size(); ++part) {
        parts_.push_back(std::make_shared<const PictureSampler>(scene, settings_of_part(settings, *mixture_, part)));
        const SampleLayout& layout = parts_.back()->layout();
        splats_.push_back(mixture_->parts[part].path_method->splats()
                              ? static_cast<double>(layout.paths()) / layout.pixels() / settings.replicate_size
                              : 0.0);
    }
}

double MixedSampler::weight(std::size_t part, std::size_t quantity, std::uint32_t pixel) const {
    return mixture_->weight(part, quantity, mixture_->blocks.of(pixel, width_, height_));
}

double MixedSampler::scale(std::size_t part, std::size_t quantity, std::uint32_t pixel) const {
    const double own = parts_[part]->layout().size(pixel) / static_cast<double>(settings_.replicate_size), other = splats_[part];
    // If both its own samples and paths from the lights contribute to the pixel, the smaller number is taken.
    const double samples = own > 0.0 && other > 0.0 ? std::min(own, other) : std::max(own, other);
    return samples > 0.0 ? weight(part, quantity, pixel) / samples : 0.0;
}

double MixedSampler::scale(std::size_t part, std::size_t quantity, const Vec2& position) const {
    return scale(part, quantity, pixel_at(scene_->film, position));
}

std::vector<Rgb> MixedSampler::retrace(std::uint64_t, std::uint32_t, PathObserver&) const {
    throw std::logic_error("MixedSampler: paths are its parts'");
}

PathSampler::OfPart MixedSampler::part_of(const SampleName& name) const {
    const std::size_t part = name.sample % parts_.size();
    return {*parts_[part], {name.pixel, name.sample / parts_.size()}, part, mixture_->parts[part].method};
}

bool MixedSampler::sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                                  const Watch& watch) const {
    const std::size_t Q = settings_.quantities(), parts = parts_.size();
    const std::uint32_t pixels = width_ * height_;
    double done = 0.0;
    for (std::size_t part = 0; part < parts; ++part) {
        const double share = mixture_->parts[part].share;
        Watch of_part = watch;
        of_part.progress = [&](const RenderProgress& of) { watch.progress({.fraction = done + share * of.fraction}); };
        std::vector<Rgb> own(picture.size(), Rgb(0.0));
        SampleRanges own_ranges;
        own_ranges.of.resize(picture.size());
        Tally counted(Q);
        if (!parts_[part]->path_sampler().sample_picture(replicate, own, own_ranges, counted, of_part)) return false;
        done += share;

        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, pixels, 256), [&](const auto& range) {
            for (std::uint32_t pixel = range.begin(); pixel < range.end(); ++pixel)
                for (std::size_t q = 0; q < Q; ++q) {
                    const std::size_t i = pixel * Q + q;
                    picture[i] += own[i] * weight(part, q, pixel);
                    const SampleRange& own_range = own_ranges.of[i];
                    if (own_range.smallest[0] > own_range.largest[0]) continue;
                    const double unit = scale(part, q, pixel);
                    ranges.of[i].add(Rgb(own_range.smallest[0], own_range.smallest[1], own_range.smallest[2]) * unit);
                    ranges.of[i].add(Rgb(own_range.largest[0], own_range.largest[1], own_range.largest[2]) * unit);
                }
        });
        const auto rename = [&](SamplePlace& place) { place.name.sample = place.name.sample * parts + part; };
        for (NonFiniteSample& sample : counted.non_finite) rename(sample.place);
        // The method itself found these samples large. If the blocks' weights differ, some that it did not keep may be larger.
        for (std::size_t q = 0; q < Q; ++q) {
            const LargestSamples own_largest = std::exchange(counted.largest[q], {});
            counted.largest[q].outdo(tally.largest[q]);
            counted.largest[q].add_count(own_largest.count());
            for (LargestSamples::Sample sample : own_largest.kept()) {
                sample.value *= scale(part, q, sample.place.pixel);
                rename(sample.place);
                counted.largest[q].add(sample.value, sample.place);
            }
        }
        tally.merge(counted);
    }
    return true;
}

}  // namespace neumann
