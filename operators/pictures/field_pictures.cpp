#include "operators/pictures/field_pictures.h"

#include "core/base/stopwatch.h"
#include "core/scene/camera_sample.h"
#include "operators/matrix/ray_table.h"
#include "operators/matrix/scene_patches.h"
#include "operators/matrix/traced_series.h"
#include "operators/pictures/field_memory.h"
#include "operators/pictures/link_pictures.h"
#include "operators/plan/half_spaces.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <atomic>
#include <numeric>

namespace neumann {

namespace {

// Streams that differ from those of the series.
constexpr std::uint64_t picture_stream = 0x706963747572ull, gather_stream = 0x676174686572ull;
constexpr std::uint32_t samples_at_once = 64;

struct Workspace {
    std::vector<Sampler> samplers, gather_samplers;  // one for each sample; one for each pixel
    std::vector<PixelSample> samples;
    std::vector<float> values, difference;  // pixel by pixel; for the values, replicate by replicate; quantity by quantity
    std::array<std::uint64_t, 3> rays{};
};

EnergyBalance power_balance(const std::vector<TracedSeries>& replicates) {
    std::vector<std::vector<EnergyShares>> all;
    for (const TracedSeries& series : replicates) {
        const std::vector<PowerOfTerm>& power = series.power;
        auto& shares = all.emplace_back(1, EnergyShares{power[0].emitted, 0.0, power[0].left, power[0].caught});
        for (std::size_t i = 1; i < power.size(); ++i)
            shares.push_back({power[i - 1].caught, power[i - 1].absorbed, power[i].left, power[i].caught});
    }
    return balance(all);
}

}  // namespace

FieldPictures::FieldPictures(const Film& film, const FieldSettings& settings)
    : importance(settings.reading == FieldReading::importance),
      width_(film.crop_width),
      height_(film.crop_height),
      replicates_(settings.replicates),
      quantities_(static_cast<std::size_t>(settings.bounces) + 2),
      stride_(3 * quantities_ * (replicates_ + 1)),
      values_(make_large_array<float>(stride_ * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_))),
      means_(make_large_array<float>(3 * quantities_ * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_))) {}

Estimate FieldPictures::picture(std::size_t first, std::size_t last) const {
    const auto black = [&] { return Image(width_, height_); };
    Estimate result{black(), black(), replicates_ - 1.0, black(), false};
    const std::size_t pixels = result.mean.pixels.size();
    const auto n = static_cast<double>(replicates_);
    const auto value = [&](std::size_t pixel, std::size_t replicate) {
        const float* v = values_.get() + pixel * stride_ + 3 * quantities_ * replicate;
        Rgb sum(0.0);
        for (std::size_t q = first; q <= last; ++q) sum += Rgb(v[3 * q], v[3 * q + 1], v[3 * q + 2]);
        return sum;
    };
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, pixels, 1024), [&](const auto& range) {
        std::vector<Rgb> found(replicates_);
        for (std::size_t pixel = range.begin(); pixel < range.end(); ++pixel) {
            Rgb sum(0.0), squares(0.0);
            for (std::uint32_t r = 0; r < replicates_; ++r) sum += found[r] = value(pixel, r);
            const Rgb mean = sum / n;
            for (const Rgb& x : found) squares += (x - mean) * (x - mean);
            Rgb least(0.0);
            for (std::size_t q = first; q <= last; ++q) {
                const float* const m = means_.get() + 3 * (q * pixels + pixel);
                least += resolution_.in_pixel(q) * glm::abs(Rgb(m[0], m[1], m[2]));
            }
            result.mean.pixels[pixel] = mean;
            result.standard_error.pixels[pixel] = replicates_ > 1 ? glm::max(glm::sqrt(squares / (n * (n - 1.0))), least)
                                                                  : Rgb(std::numeric_limits<double>::infinity());
            result.discretisation.pixels[pixel] = glm::abs(value(pixel, replicates_));
        }
    });
    return result;
}

void FieldPictures::set_replicate(std::uint32_t replicate, std::span<const Rgb> picture) {
    for (std::size_t i = 0; i < picture.size(); ++i) {
        float* const to = values(i / quantities_) + 3 * (quantities_ * replicate + i % quantities_);
        for (int c = 0; c < 3; ++c) to[c] = static_cast<float>(picture[i][c]);
    }
}

double FieldPictures::relative_noise(std::size_t quantity) const {
    const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    const double n = replicates_;
    double errors = 0.0, means = 0.0;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0.0, squares = 0.0;
            for (std::size_t r = 0; r < replicates_; ++r) {
                const double x = values_[pixel * stride_ + 3 * (quantities_ * r + quantity) + c];
                sum += x;
                squares += x * x;
            }
            errors += (squares - sum * sum / n) / (n * (n - 1.0));
            means += sum * sum / (n * n);
        }
    return means > 0.0 && n > 1.0 ? std::sqrt(errors / means) : std::numeric_limits<double>::infinity();
}

void FieldPictures::set_to_zero(std::size_t quantity) {
    const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        for (std::size_t r = 0; r < replicates_; ++r) std::fill_n(values(pixel) + 3 * (quantities_ * r + quantity), 3, 0.0f);
}

void FieldPictures::find_means(std::size_t begin, std::size_t end) {
    const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    const float part = 1.0f / static_cast<float>(replicates_);
    for (std::size_t q = 0; q < quantities_; ++q)
        for (std::size_t pixel = begin; pixel < end; ++pixel) {
            float* const mean = means_.get() + 3 * (q * pixels + pixel);
            const float* const v = values(pixel) + 3 * q;
            for (std::size_t c = 0; c < 3; ++c) {
                float sum = 0.0f;
                for (std::size_t r = 0; r < replicates_; ++r) sum += v[3 * quantities_ * r + c];
                mean[c] = sum * part;
            }
        }
}

Image FieldPictures::term_mean(std::size_t i) const {
    Image result(width_, height_);
    const float* const mean = means_.get() + 3 * i * result.pixels.size();
    oneapi::tbb::parallel_for(std::size_t{0}, result.pixels.size(), [&](std::size_t pixel) {
        result.pixels[pixel] = Rgb(mean[3 * pixel], mean[3 * pixel + 1], mean[3 * pixel + 2]);
    });
    return result;
}

MeanWithError FieldPictures::mean(std::size_t first, std::size_t last, std::size_t which) const {
    const auto n = static_cast<double>(replicates_);
    double sum = 0.0, squares = 0.0;
    std::vector<double> of_replicate(replicates_);
    for (std::uint32_t r = 0; r < replicates_; ++r) {
        for (std::size_t q = first; q <= last; ++q) of_replicate[r] += replicate_mean(r, q, which);
        sum += of_replicate[r];
    }
    for (const double x : of_replicate) squares += (x - sum / n) * (x - sum / n);
    double least = 0.0;
    for (std::size_t q = first; q <= last; ++q)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::uint32_t r = 0; r < replicates_; ++r)
                if (which == c || which == 3)
                    least += std::abs(replicate_mean(r, q, c)) * resolution_.of_mean(q)[static_cast<int>(c)] /
                             (n * (which == 3 ? 3.0 : 1.0));
    return {sum / n, n > 1.0 ? std::max(std::sqrt(squares / (n * (n - 1.0))), least) : std::numeric_limits<double>::infinity(),
            n - 1.0};
}

PictureMeans FieldPictures::means(std::size_t first, std::size_t last) const {
    PictureMeans means;
    for (std::size_t c = 0; c < 3; ++c) means.channel[c] = mean(first, last, c);
    means.all = mean(first, last);
    return means;
}

std::optional<FieldPictures> render_fields(const Scene& scene, const FieldSettings& settings, const Watch& watch) {
    const Stopwatch field_watch;
    const auto asked = static_cast<double>(settings.patching.patches);
    check_field_memory(settings, scene.film, {asked, asked, asked * settings.rays});
    const Glossy glossy = shows_patches(settings.reading) ? Glossy::in_cells : glossy_of_pictures(scene);
    const PatchSpace space = scene_patches(scene, settings.patching, glossy), coarser = space.coarser();
    check_camera(scene);
    const auto patches = static_cast<double>(space.patches().size());
    const auto table_rays = static_cast<double>(RayTable::size(space, settings.rays));
    const double n_replicates = settings.replicates;
    const bool has_links = glossy == Glossy::by_rays;
    check_field_memory(settings, scene.film, {patches, static_cast<double>(space.size()), table_rays, has_links});
    FieldPictures result(scene.film, settings);
    result.has_links = has_links;
    result.rays.resize(static_cast<std::size_t>(settings.bounces) + 2);
    const std::size_t later = std::min<std::size_t>(2, result.rays.size() - 1);
    std::vector<TracedSeries> series;
    result.rest_converges = settings.rest;
    for (std::uint32_t r = 0; r < settings.replicates; ++r) {
        const auto trace = result.importance ? trace_importance : trace_series;
        try {
            series.push_back(trace(scene, space, coarser,
                                   {settings.bounces, settings.rays, settings.light_samples, settings.seed * 0x10001 + r,
                                    settings.rest, glossy, settings.samples},
                                   watch));
        } catch (const Stopped&) {
            return std::nullopt;
        }
        result.rays[later] += series.back().rays;
        result.rest_converges = result.rest_converges && series.back().rest_converges;
    }
    if (!result.importance) result.power = power_balance(series);
    result.patches = space.patches().size();
    result.unknowns = space.size();
    for (const Facet& facet : space.facets()) ++result.sides[facet.cells.size()];
    result.samples = std::uint64_t{settings.samples} * settings.replicates;
    result.field_seconds = field_watch.seconds();

    RayCounts counts;
    counts.of_facet = settings.rays * n_replicates;
    counts.all = table_rays * n_replicates;
    for (const TracedSeries& s : series) counts.lights += static_cast<double>(s.light_rays);
    counts.lights_of_facet = counts.lights / static_cast<double>(space.facets().size());
    if (settings.reading == FieldReading::gather) counts.gathered = n_replicates * settings.samples * settings.gather_rays;
    counts.pixels = static_cast<double>(scene.film.crop_width) * scene.film.crop_height;
    if (!shows_patches(settings.reading)) counts.sampled_at_pixel = settings.bounces > 0 ? 2 : 1;
    const ConvexBody body = HalfSpaces(scene.geometry).convex_body();
    counts.is_closed = body.found && body.is_closed;
    result.set_resolution(RayResolution(series, counts));

    const Stopwatch picture_watch;
    const auto pixels = static_cast<std::uint32_t>(scene.film.crop_width) * static_cast<std::uint32_t>(scene.film.crop_height);
    std::vector<LinkFields> by_links;
    if (series.front().fine_by_links && shows_links(scene)) {
        const double rays = std::max(table_rays, static_cast<double>(pixels) * settings.samples);
        std::vector<LinkRaster> rasters;
        for (std::uint32_t r = 0; r < settings.replicates; ++r) try {
                LinkPictures links = picture_links(scene, space, rays, settings.seed * 0x10001 + r, settings.bounces, watch);
                result.rays[later] += links.rays;
                result.set_replicate(r, links.picture);
                rasters.push_back(std::move(links.raster));
            } catch (const Stopped&) {
                return std::nullopt;
            }
        by_links = divide_by_links(series, std::move(rasters), [&](std::size_t k) { return result.relative_noise(k); });
        for (std::size_t k = 2; k < result.quantities(); ++k)
            if (!by_links.front().shown_as_points[k]) result.set_to_zero(k);
    }
    const int width = scene.film.crop_width;
    const std::size_t stride = 3 * result.quantities(), all = stride * settings.replicates;
    const SobolPoints sobol(settings.samples), gather_sobol(settings.samples * settings.gather_rays);
    // Only the first samples of a replicate, which are also well distributed, are compared with coarser patches. With gather all
    // are, because the reader compares only some gather rays.
    const std::uint32_t compared = settings.reading == FieldReading::gather ? settings.samples : (settings.samples + 3) / 4;
    const float difference_weight = 1.0f / static_cast<float>(compared * settings.replicates);
    const FieldReader reader(scene, settings.reading, settings.bounces, settings.gather_rays);
    const std::uint32_t pixels_at_once = std::max(1u, samples_at_once / settings.samples);
    const std::uint32_t groups = (pixels + pixels_at_once - 1) / pixels_at_once;
    constexpr std::size_t each = FieldPictures::sums_of_quantity;
    const std::size_t sums_of_group = result.quantities() * settings.replicates * each;
    std::vector<double> sums(groups * sums_of_group);

    const auto render = [&](std::uint32_t group, Workspace& work) {
        const std::uint32_t begin = group * pixels_at_once, end = std::min(begin + pixels_at_once, pixels);
        work.values.assign((end - begin) * all, 0.0f);
        work.difference.assign((end - begin) * stride, 0.0f);
        const std::size_t count = (end - begin) * settings.samples;
        work.samplers.clear();
        work.gather_samplers.clear();
        for (std::uint32_t pixel = begin; pixel < end; ++pixel) {
            work.gather_samplers.emplace_back(gather_sobol, settings.seed ^ gather_stream, pixel);
            work.samplers.resize(work.samplers.size() + settings.samples, Sampler(sobol, settings.seed ^ picture_stream, pixel));
        }
        for (std::uint32_t r = 0; r < settings.replicates; ++r) {
            work.samples.clear();
            for (std::size_t i = 0; i < count; ++i) {
                const auto offset = static_cast<std::uint32_t>(i / settings.samples), pixel = begin + offset;
                Sampler& sampler = work.samplers[i];
                const std::uint64_t sample_number = std::uint64_t{r} * settings.samples + i % settings.samples;
                sampler.start(sample_number);
                const CameraSample sample = sample_camera(scene, scene.film.crop_x + static_cast<int>(pixel) % width,
                                                          scene.film.crop_y + static_cast<int>(pixel) / width, sampler);
                work.samples.push_back({sample.ray, sample.weight, work.values.data() + offset * all + r * stride,
                                        i % settings.samples < compared ? work.difference.data() + offset * stride : nullptr,
                                        difference_weight, &sampler, &work.gather_samplers[offset],
                                        sample_number * settings.gather_rays});
            }
            const TracedSeries& s = series[r];
            const auto rays = reader.read({s.fine, s.coarse, by_links.empty() ? nullptr : &by_links[r]}, work.samples);
            for (std::size_t k = 0; k < 3; ++k) work.rays[k] += rays[k];
        }
        const float scale = 1.0f / static_cast<float>(settings.samples);
        double* const group_sums = sums.data() + group * sums_of_group;
        for (std::uint32_t pixel = begin; pixel < end; ++pixel) {
            const float *found = work.values.data() + (pixel - begin) * all,
                        *difference = work.difference.data() + (pixel - begin) * stride;
            float* const values = result.values(pixel);
            for (std::size_t k = 0; k < all; ++k) values[k] = (by_links.empty() ? 0.0f : values[k]) + found[k] * scale;
            std::copy_n(difference, stride, values + all);
            for (std::size_t q = 0; q < sums_of_group / each; ++q) {
                for (std::size_t c = 0; c < 3; ++c) group_sums[each * q + c] += double{values[3 * q + c]};
                group_sums[each * q + 3] += (double{values[3 * q]} + values[3 * q + 1] + values[3 * q + 2]) / 3.0;
            }
        }
        result.find_means(begin, end);
    };
    std::atomic<bool> dropped = false;
    oneapi::tbb::enumerable_thread_specific<Workspace> workspaces;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, groups, 4), [&](const auto& range) {
        if (watch.stop()) dropped = true;
        if (dropped) return;
        Workspace& work = workspaces.local();
        for (std::uint32_t group = range.begin(); group < range.end(); ++group) render(group, work);
    });
    if (dropped) return std::nullopt;
    // Added in a fixed order, so that the result does not depend on threads.
    result.sums.assign(sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(sums_of_group));
    for (std::uint32_t group = 1; group < groups; ++group)
        for (std::size_t k = 0; k < sums_of_group; ++k) result.sums[k] += sums[group * sums_of_group + k];
    for (const Workspace& work : workspaces)
        for (std::size_t k = 0; k < 3; ++k) result.rays[std::min(k, later)] += work.rays[k];
    result.picture_seconds = picture_watch.seconds();
    return result;
}

PictureError picture_error(const Estimate& picture) {
    const double sampling = relative_standard_error(picture), difference = relative_discretisation(picture);
    return {sampling, std::sqrt(std::max(difference * difference - sampling * sampling, 0.0))};
}

DiscretisationReport report_discretisation(const Estimate& picture, const PictureError& of_picture) {
    DiscretisationReport report;
    const Image& error = picture.discretisation;
    for (std::size_t i = 0; i < error.pixels.size(); ++i) {
        report.mean += mean_component(error.pixels[i]) / static_cast<double>(error.pixels.size());
        if (max_component(error.pixels[i]) <= report.worst) continue;
        report.worst = max_component(error.pixels[i]);
        report.worst_x = static_cast<int>(i) % error.width;
        report.worst_y = static_cast<int>(i) / error.width;
    }
    report.relative = of_picture.discretisation;
    return report;
}

}  // namespace neumann
