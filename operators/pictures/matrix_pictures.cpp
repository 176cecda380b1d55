#include "operators/pictures/matrix_pictures.h"

#include "operators/matrix/sides.h"
#include "operators/matrix/traced_series.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <chrono>

namespace neumann {

namespace {

constexpr std::uint64_t picture_stream = 0x706963747572ull;  // another seed than the series'
constexpr std::uint32_t samples_at_once = 64;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Mean and standard error of the replicates, and the mean of |fine − coarse|, of one value.
struct Moments {
    double mean, standard_error, difference;
};
Moments moments(const float* fine, const float* coarse, std::size_t step, std::uint32_t replicates) {
    const auto n = static_cast<double>(replicates);
    double sum = 0.0, difference = 0.0, squares = 0.0;
    for (std::uint32_t r = 0; r < replicates; ++r) {
        sum += fine[r * step];
        difference += static_cast<double>(fine[r * step]) - static_cast<double>(coarse[r * step]);
    }
    const double mean = sum / n;
    for (std::uint32_t r = 0; r < replicates; ++r) squares += (fine[r * step] - mean) * (fine[r * step] - mean);
    return {mean, replicates > 1 ? std::sqrt(squares / (n * (n - 1.0))) : std::numeric_limits<double>::infinity(),
            std::abs(difference / n)};
}

struct Workspace {
    std::vector<SobolSampler> samplers;
    std::vector<PixelSample> samples;
    std::vector<float> fine, coarse;  // pixel by pixel, replicate by replicate
    std::array<std::uint64_t, 3> rays{};
};

}  // namespace

MatrixPictures render_matrix(const Scene& scene, const MatrixSettings& settings) {
    const auto start = std::chrono::steady_clock::now();
    MatrixPictures result;
    const PatchSpace space(scene.geometry, settings.patching, side_directions(scene)), coarser = space.coarser();
    std::vector<TracedSeries> series;
    for (std::uint32_t r = 0; r < settings.replicates; ++r) {
        series.push_back(trace_series(scene, space, coarser,
                                      {settings.bounces, settings.rays, settings.light_samples, settings.seed * 0x10001 + r}));
        result.field_rays += series.back().rays;
    }
    result.patches = space.patches().size();
    result.unknowns = space.size();
    result.field_seconds = seconds_since(start);

    const auto then = std::chrono::steady_clock::now();
    const int width = scene.film.crop_width, height = scene.film.crop_height;
    const auto pixels = static_cast<std::uint32_t>(width) * static_cast<std::uint32_t>(height);
    const std::size_t terms = static_cast<std::size_t>(settings.bounces) + 1, stride = 3 * terms,
                      all = stride * settings.replicates;
    const FieldPicture empty{{Image(width, height), Image(width, height), settings.replicates - 1.0}, Image(width, height)};
    result.terms.assign(terms, empty);
    result.sums.assign(terms, empty);
    const SobolPoints sobol(settings.samples);
    const FieldReader reader(scene, settings.method, settings.bounces, settings.gather_rays);
    const std::uint32_t pixels_at_once = std::max(1u, samples_at_once / settings.samples);

    const auto put = [&](std::vector<FieldPicture>& pictures, std::uint32_t pixel, const float* f, const float* c) {
        for (std::size_t k = 0; k < stride; ++k) {
            const Moments m = moments(f + k, c + k, stride, settings.replicates);
            FieldPicture& picture = pictures[k / 3];
            const int channel = static_cast<int>(k % 3);
            picture.estimate.mean.pixels[pixel][channel] = m.mean;
            picture.estimate.standard_error.pixels[pixel][channel] = m.standard_error;
            picture.discretisation.pixels[pixel][channel] = m.difference;
        }
    };
    const auto render = [&](std::uint32_t begin, std::uint32_t end, Workspace& work) {
        work.fine.assign((end - begin) * all, 0.0f);
        work.coarse.assign((end - begin) * all, 0.0f);
        const std::size_t count = (end - begin) * settings.samples;
        work.samplers.clear();
        for (std::uint32_t pixel = begin; pixel < end; ++pixel)
            for (std::uint32_t k = 0; k < settings.samples; ++k)
                work.samplers.emplace_back(sobol, settings.seed ^ picture_stream, pixel);
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
            float *f = work.fine.data() + (pixel - begin) * all, *c = work.coarse.data() + (pixel - begin) * all;
            // Rays at the pixel know no patches.
            if (settings.method != FieldMethod::patches)
                for (std::uint32_t r = 0; r < settings.replicates; ++r)
                    std::copy_n(f + r * stride, std::min<std::size_t>(6, stride), c + r * stride);
            for (std::size_t k = 0; k < all; ++k) {
                f[k] *= scale;
                c[k] *= scale;
            }
            put(result.terms, pixel, f, c);
            for (std::size_t k = 0; k < all; ++k)
                if (k % stride >= 3) {
                    f[k] += f[k - 3];
                    c[k] += c[k - 3];
                }
            put(result.sums, pixel, f, c);
        }
    };
    oneapi::tbb::enumerable_thread_specific<Workspace> workspaces;
    const std::uint32_t groups = (pixels + pixels_at_once - 1) / pixels_at_once;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, groups, 4), [&](const auto& range) {
        Workspace& work = workspaces.local();
        for (std::uint32_t g = range.begin(); g < range.end(); ++g)
            render(g * pixels_at_once, std::min((g + 1) * pixels_at_once, pixels), work);
    });
    for (const Workspace& work : workspaces)
        for (std::size_t k = 0; k < 3; ++k) result.rays[k] += work.rays[k];
    result.picture_seconds = seconds_since(then);
    return result;
}

}  // namespace neumann
