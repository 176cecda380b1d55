#include "operators/experiments/study/own_estimator.h"

#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "operators/experiments/queries/camera_rays.h"
#include "operators/statistics/picture_statistics.h"

#include <algorithm>

namespace neumann {

namespace {

// This many rays at once make the cost of a call negligible.
constexpr std::uint64_t rays_at_once = 1u << 16;

}  // namespace

BounceSeries render_by_own(const OwnEstimator& estimator, const Scene& scene, std::uint64_t samples, int bounces,
                           std::uint64_t seed, const Watch& watch) {
    const Stopwatch clock;
    const Film& film = scene.film;
    const auto count = static_cast<std::uint32_t>(film.crop_width * film.crop_height);
    const auto terms_of_ray = static_cast<std::size_t>(bounces) + 1;
    std::vector<Image> terms(terms_of_ray, Image(film.crop_width, film.crop_height));
    BounceSeries series;
    const std::uint64_t at_once = std::max<std::uint64_t>(rays_at_once / count, 1);
    for (std::uint64_t first = 0; first < samples; first += at_once) {
        if (watch.stop()) {
            series.outcome = Outcome::interrupted;
            return series;
        }
        const auto [rays, pixels, weights] = camera_rays(scene, first, std::min(at_once, samples - first), seed);
        const std::vector<Rgb> found = estimator(rays, pixels, bounces, seed + first);
        for (std::size_t ray = 0; ray < rays.size(); ++ray)
            for (std::size_t i = 0; i < terms_of_ray; ++i) {
                const Rgb& x = found[ray * terms_of_ray + i];
                if (!is_finite(x)) throw InputError("returned a value that is not finite");
                terms[i].pixels[ray % count] += weights[ray] / static_cast<double>(samples) * x;
            }
    }
    const auto shared = std::make_shared<const std::vector<Image>>(std::move(terms));
    series.term = [shared](std::size_t i) {
        PixelEstimate picture;
        picture.mean = (*shared)[i];
        return picture;
    };
    series.sum = [shared](std::size_t i) {
        PixelEstimate picture;
        picture.mean = shared->front();
        for (std::size_t k = 1; k <= i; ++k)
            std::ranges::transform(picture.mean.pixels, (*shared)[k].pixels, picture.mean.pixels.begin(), std::plus());
        return picture;
    };
    series.report.bounces.resize(terms_of_ray);
    for (std::size_t i = 0; i < terms_of_ray; ++i) {
        series.report.bounces[i].mean.mean = picture_mean({(*shared)[i], Image(film.crop_width, film.crop_height)}).mean;
        series.report.sum.mean += series.report.bounces[i].mean.mean;
    }
    series.samples = samples;
    series.seed = seed;
    series.rays = series.report.bounces.front().rays = samples * count;
    series.seconds = clock.seconds();
    return series;
}

}  // namespace neumann
