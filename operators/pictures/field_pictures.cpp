#include "operators/pictures/field_pictures.h"

#include "operators/matrix/sides.h"
#include "operators/matrix/traced_series.h"
#include "operators/patches/patch_memory.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <chrono>
#include <numeric>

namespace neumann {

namespace {

constexpr std::uint64_t picture_stream = 0x706963747572ull;  // another seed than the series'
constexpr std::uint32_t samples_at_once = 64;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Workspace {
    std::vector<SobolSampler> samplers;
    std::vector<PixelSample> samples;
    std::vector<float> fine, coarse;  // pixel by pixel, replicate by replicate, quantity by quantity
    std::array<std::uint64_t, 3> rays{};
};

// Puts the replicates of a pixel's quantities together.
class Development {
public:
    Development(const FieldSettings& settings, int width, int height)
        : settings_(settings), quantities_(static_cast<std::size_t>(settings.bounces) + 2) {
        const Image black(width, height);
        const FieldPicture empty{{black, black, settings.replicates - 1.0, black, false}, {}};
        terms_.assign(quantities_, empty);
        sums_.assign(quantities_ - 1, empty);
    }
    std::size_t quantities() const { return quantities_; }

    // `fine` and `coarse`: of the pixel. `means`: replicate by replicate, of all terms and then of all sums; added to.
    void develop(std::size_t pixel, float* fine, float* coarse, double* means) {
        for (std::size_t q = 0; q < quantities_; ++q) put(terms_[q], q, pixel, fine, coarse, means + q);
        for (std::uint32_t r = 0; r < settings_.replicates; ++r)
            for (std::size_t k = 3; k < 3 * (quantities_ - 1); ++k) {
                fine[r * 3 * quantities_ + k] += fine[r * 3 * quantities_ + k - 3];
                coarse[r * 3 * quantities_ + k] += coarse[r * 3 * quantities_ + k - 3];
            }
        for (std::size_t q = 0; q + 1 < quantities_; ++q) put(sums_[q], q, pixel, fine, coarse, means + quantities_ + q);
    }
    std::size_t means_of_replicate() const { return 2 * quantities_; }

    void finish(FieldPictures& result, const std::vector<double>& means) {
        for (std::size_t q = 0; q < quantities_; ++q) terms_[q].mean = mean(means, q);
        for (std::size_t q = 0; q + 1 < quantities_; ++q) sums_[q].mean = mean(means, quantities_ + q);
        result.rest = std::move(terms_.back());
        terms_.pop_back();
        result.terms = std::move(terms_);
        result.sums = std::move(sums_);
    }

private:
    void put(FieldPicture& out, std::size_t q, std::size_t pixel, const float* fine, const float* coarse, double* means) {
        const auto n = static_cast<double>(settings_.replicates);
        Rgb sum(0.0), difference(0.0), squares(0.0);
        const auto at = [&](const float* values, std::uint32_t r) {
            const float* v = values + 3 * (r * quantities_ + q);
            return Rgb(v[0], v[1], v[2]);
        };
        for (std::uint32_t r = 0; r < settings_.replicates; ++r) {
            const Rgb value = at(fine, r);
            sum += value;
            difference += value - at(coarse, r);
            means[r * means_of_replicate()] += mean_component(value);
        }
        const Rgb mean = sum / n;
        for (std::uint32_t r = 0; r < settings_.replicates; ++r) squares += (at(fine, r) - mean) * (at(fine, r) - mean);
        out.picture.mean.pixels[pixel] = mean;
        out.picture.standard_error.pixels[pixel] =
            settings_.replicates > 1 ? glm::sqrt(squares / (n * (n - 1.0))) : Rgb(std::numeric_limits<double>::infinity());
        out.picture.discretisation.pixels[pixel] = glm::abs(difference) / n;
    }
    MeanWithError mean(const std::vector<double>& means, std::size_t at) const {
        const auto n = static_cast<double>(settings_.replicates), pixels = static_cast<double>(sums_[0].picture.mean.pixels.size());
        double sum = 0.0, squares = 0.0;
        for (std::uint32_t r = 0; r < settings_.replicates; ++r) sum += means[r * means_of_replicate() + at] / pixels;
        for (std::uint32_t r = 0; r < settings_.replicates; ++r) {
            const double d = means[r * means_of_replicate() + at] / pixels - sum / n;
            squares += d * d;
        }
        return {sum / n, n > 1.0 ? std::sqrt(squares / (n * (n - 1.0))) : std::numeric_limits<double>::infinity(), n - 1.0};
    }

    const FieldSettings& settings_;
    std::size_t quantities_;
    std::vector<FieldPicture> terms_, sums_;
};

}  // namespace

std::optional<FieldPictures> render_fields(const Scene& scene, const FieldSettings& settings,
                                           const std::function<bool()>& interrupted) {
    const auto start = std::chrono::steady_clock::now();
    FieldPictures result;
    result.rays.resize(static_cast<std::size_t>(settings.bounces) + 2);
    const std::size_t later = std::min<std::size_t>(2, result.rays.size() - 1);
    // Both sides of a patch: a row of T, and for all replicates the quantities of the finer and the coarser field.
    check_patch_memory(settings.patching.patches, settings.rays,
                       2.0 * (4.0 * settings.rays + 15.0 * settings.replicates * (settings.bounces + 2.0)) + 300.0);
    const PatchSpace space(scene.geometry, settings.patching, side_directions(scene)), coarser = space.coarser();
    std::vector<TracedSeries> series;
    result.rest_converges = settings.rest;
    for (std::uint32_t r = 0; r < settings.replicates; ++r) {
        series.push_back(
            trace_series(scene, space, coarser,
                         {settings.bounces, settings.rays, settings.light_samples, settings.seed * 0x10001 + r, settings.rest}));
        result.rays[later] += series.back().rays;
        result.rest_converges = result.rest_converges && series.back().rest_converges;
    }
    result.patches = space.patches().size();
    result.unknowns = space.size();
    result.samples = std::uint64_t{settings.samples} * settings.replicates;
    result.field_seconds = seconds_since(start);

    const auto then = std::chrono::steady_clock::now();
    const int width = scene.film.crop_width, height = scene.film.crop_height;
    const auto pixels = static_cast<std::uint32_t>(width) * static_cast<std::uint32_t>(height);
    Development development(settings, width, height);
    const std::size_t stride = 3 * development.quantities(), all = stride * settings.replicates;
    const SobolPoints sobol(settings.samples);
    const FieldReader reader(scene, settings.method, settings.bounces, settings.gather_rays);
    const std::uint32_t pixels_at_once = std::max(1u, samples_at_once / settings.samples);
    const std::uint32_t groups = (pixels + pixels_at_once - 1) / pixels_at_once;
    const std::size_t means_of_group = development.means_of_replicate() * settings.replicates;
    std::vector<double> means(groups * means_of_group);

    const auto render = [&](std::uint32_t group, Workspace& work) {
        const std::uint32_t begin = group * pixels_at_once, end = std::min(begin + pixels_at_once, pixels);
        work.fine.assign((end - begin) * all, 0.0f);
        work.coarse.assign((end - begin) * all, 0.0f);
        const std::size_t count = (end - begin) * settings.samples;
        work.samplers.clear();
        for (std::uint32_t pixel = begin; pixel < end; ++pixel)
            work.samplers.resize(work.samplers.size() + settings.samples,
                                 SobolSampler(sobol, settings.seed ^ picture_stream, pixel));
        for (std::uint32_t r = 0; r < settings.replicates; ++r) {
            work.samples.clear();
            for (std::size_t i = 0; i < count; ++i) {
                const auto offset = static_cast<std::uint32_t>(i / settings.samples), pixel = begin + offset;
                SobolSampler& sampler = work.samplers[i];
                sampler.start(std::uint64_t{r} * settings.samples + i % settings.samples);
                const Vec2 film = sample(scene.film.filter, sampler.next2(), scene.film.crop_x + static_cast<int>(pixel) % width,
                                         scene.film.crop_y + static_cast<int>(pixel) / width, scene.film.width, scene.film.height);
                const std::size_t values = offset * all + r * stride;
                work.samples.push_back({scene.camera.ray(film), work.fine.data() + values, work.coarse.data() + values, &sampler});
            }
            const auto rays = reader.read({series[r].fine, series[r].coarse}, work.samples);
            for (std::size_t k = 0; k < 3; ++k) work.rays[k] += rays[k];
        }
        const float scale = 1.0f / static_cast<float>(settings.samples);
        for (std::uint32_t pixel = begin; pixel < end; ++pixel) {
            float *fine = work.fine.data() + (pixel - begin) * all, *coarse = work.coarse.data() + (pixel - begin) * all;
            for (std::uint32_t r = 0; r < settings.replicates; ++r)
                reader.copy_what_needs_no_patches(fine + r * stride, coarse + r * stride);
            for (std::size_t k = 0; k < all; ++k) {
                fine[k] *= scale;
                coarse[k] *= scale;
            }
            development.develop(pixel, fine, coarse, means.data() + group * means_of_group);
        }
    };
    oneapi::tbb::enumerable_thread_specific<Workspace> workspaces;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, groups, 4), [&](const auto& range) {
        if (interrupted()) return;
        Workspace& work = workspaces.local();
        for (std::uint32_t group = range.begin(); group < range.end(); ++group) render(group, work);
    });
    if (interrupted()) return std::nullopt;
    // In a fixed order, so that threads do not matter.
    for (std::uint32_t group = 1; group < groups; ++group)
        for (std::size_t k = 0; k < means_of_group; ++k) means[k] += means[group * means_of_group + k];
    development.finish(result, means);
    for (const Workspace& work : workspaces)
        for (std::size_t k = 0; k < 3; ++k) result.rays[std::min(k, later)] += work.rays[k];
    result.picture_seconds = seconds_since(then);
    return result;
}

PictureError picture_error(const Estimate& picture) {
    const double sampling = relative_standard_error(picture), difference = relative_discretisation(picture);
    return {sampling, std::sqrt(std::max(difference * difference - sampling * sampling, 0.0))};
}

}  // namespace neumann
