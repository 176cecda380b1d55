#include "operators/render/from_fields/field_pixels.h"

#include "core/scene/camera_sample.h"

namespace neumann {

namespace {

// These streams differ from those of the series.
constexpr std::uint64_t picture_stream = 0x706963747572ull, gather_stream = 0x676174686572ull;
// The samples of a group of pixels that are read at once, and the most of a single pixel, which may have any number.
constexpr std::uint32_t samples_at_once = 64, most_at_once = 4096;

}  // namespace

FieldPixels::FieldPixels(const Scene& scene, const FieldSettings& settings)
    : scene_(scene),
      settings_(settings),
      width_(static_cast<std::uint32_t>(scene.film.crop_width)),
      pixels_(width_ * static_cast<std::uint32_t>(scene.film.crop_height)),
      group_(std::max(1u, samples_at_once / settings.samples)),
      stride_(3 * (static_cast<std::size_t>(settings.bounces) + 2)),
      sobol_(settings.samples),
      gather_sobol_(settings.samples * settings.gather_rays),
      // Only the first samples of a replicate, which are also well distributed, are compared with coarser patches. With
      // gather all of them are, because the reader compares only some gather rays.
      compared_(settings.reading == FieldReading::gather ? settings.samples : (settings.samples + 3) / 4),
      reader_(scene, settings.reading, settings.bounces, settings.gather_rays) {}

RaysByBounce FieldPixels::read(std::uint32_t group, std::span<const TracedSeries> series, std::span<const LinkFields> by_links,
                               FieldPictures& pictures, Workspace& work) const {
    const Film& film = scene_.film;
    const std::uint32_t begin = group * group_, end = std::min(begin + group_, pixels_);
    const std::size_t all = stride_ * settings_.replicates;
    const std::uint32_t at_once = std::min(settings_.samples, most_at_once);
    const double difference_weight = 1.0 / (static_cast<double>(compared_) * settings_.replicates);
    RaysByBounce cast{};
    work.values.assign((end - begin) * all, 0.0);
    work.difference.assign((end - begin) * stride_, 0.0);
    work.samplers.clear();
    work.gather_samplers.clear();
    for (std::uint32_t pixel = begin; pixel < end; ++pixel) {
        work.gather_samplers.emplace_back(gather_sobol_, settings_.seed ^ gather_stream, pixel);
        work.samplers.resize(work.samplers.size() + at_once, Sampler(sobol_, settings_.seed ^ picture_stream, pixel));
    }
    const auto take = [&](std::uint32_t r, std::uint32_t first) {
        work.samples.clear();
        for (std::size_t i = 0; i < work.samplers.size(); ++i) {
            const auto offset = static_cast<std::uint32_t>(i / at_once), pixel = begin + offset;
            const std::uint64_t of_replicate = first + i % at_once,
                                sample_number = std::uint64_t{r} * settings_.samples + of_replicate;
            Sampler& sampler = work.samplers[i];
            sampler.start(sample_number);
            const CameraSample sample = sample_camera(scene_, film.crop_x + static_cast<int>(pixel % width_),
                                                      film.crop_y + static_cast<int>(pixel / width_), sampler);
            work.samples.push_back({sample.ray, sample.weight, work.values.data() + offset * all + r * stride_,
                                    of_replicate < compared_ ? work.difference.data() + offset * stride_ : nullptr,
                                    difference_weight, &sampler, &work.gather_samplers[offset],
                                    sample_number * settings_.gather_rays});
        }
        const TracedSeries& s = series[r];
        const auto rays = reader_.read({s.fine, s.coarse, by_links.empty() ? nullptr : &by_links[r]}, work.samples);
        for (std::size_t k = 0; k < 3; ++k) cast[k] += rays[k];
    };
    for (std::uint32_t r = 0; r < settings_.replicates; ++r)
        for (std::uint32_t first = 0; first < settings_.samples; first += at_once) take(r, first);
    const double scale = 1.0 / settings_.samples;
    for (std::uint32_t pixel = begin; pixel < end; ++pixel) {
        const double *found = work.values.data() + (pixel - begin) * all,
                     *difference = work.difference.data() + (pixel - begin) * stride_;
        float* const values = pictures.values(pixel);
        for (std::size_t k = 0; k < all; ++k)
            values[k] = static_cast<float>((by_links.empty() ? 0.0 : double{values[k]}) + found[k] * scale);
        for (std::size_t k = 0; k < stride_; ++k) values[all + k] = static_cast<float>(difference[k]);
    }
    return cast;
}

}  // namespace neumann
