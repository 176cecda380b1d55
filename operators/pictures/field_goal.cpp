#include "operators/pictures/field_goal.h"

#include "core/base/stopwatch.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace neumann {

namespace {

constexpr std::size_t fewest_patches = 500, most_patches = 250'000;
constexpr std::uint32_t fewest_rays = 16, most_rays = 1024, most_samples = 1024;
// A step multiplies no part by more than this: estimates from few samples are rough.
constexpr double most_growth = 8.0;
constexpr std::uint32_t most_light_samples = 64;

double square(double x) { return x * x; }

// The largest error of any term that rays at the pixel make, that fields make by their rays, and that fields make by their patches.
struct Parts {
    double pixels = 0.0, rays = 0.0, patches = 0.0;
};
Parts largest_parts(const std::vector<PictureError>& errors, FieldMethod method) {
    Parts parts;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const PictureError& error = errors[i];
        const bool at_pixel = i < 2 && method != FieldMethod::patches;
        (at_pixel ? parts.pixels : parts.rays) = std::max(at_pixel ? parts.pixels : parts.rays, error.sampling);
        parts.patches = std::max(parts.patches, error.discretisation);
    }
    return parts;
}

std::uint32_t grow(std::uint32_t n, double factor, std::uint32_t most) {
    return std::min(most, n * std::bit_ceil(static_cast<std::uint32_t>(std::ceil(std::clamp(factor, 1.0, most_growth)))));
}

// More of what makes the error; false where nothing can grow any more.
bool grow(FieldSettings& settings, const Parts& parts, double target) {
    const FieldSettings before = settings;
    const double part = target * std::sqrt(0.5);  // half the error's square for sampling, half for patches
    // Noise of later bounces comes from both the pixel's samples and the fields' rays.
    settings.samples = grow(settings.samples, square(std::max(parts.pixels, parts.rays) / part), most_samples);
    settings.rays = grow(settings.rays, square(parts.rays / part), most_rays);
    settings.light_samples = std::min(settings.rays, most_light_samples);
    // Linear interpolation errs like a patch's area, beside edges like its width.
    settings.patching.patches =
        std::min(most_patches, static_cast<std::size_t>(static_cast<double>(settings.patching.patches) *
                                                        std::clamp(square(parts.patches / part), 1.0, most_growth)));
    return settings.samples != before.samples || settings.rays != before.rays ||
           settings.patching.patches != before.patching.patches;
}

FieldRun make_run(FieldPictures pictures, const FieldSettings& settings, std::vector<Checkpoint> before, double seconds) {
    FieldRun run{std::move(pictures), settings, std::move(before), {}};
    run.seconds = seconds;
    Checkpoint checkpoint;
    checkpoint.samples = run.pictures.samples;
    checkpoint.rays = std::accumulate(run.pictures.rays.begin(), run.pictures.rays.end(), std::uint64_t{0});
    checkpoint.seconds = seconds;
    for (std::size_t i = 0; i <= run.pictures.bounces(); ++i) {
        run.term_errors.push_back(picture_error(run.pictures.term(i)));
        checkpoint.term_error.push_back(run.term_errors.back().all());
    }
    checkpoint.sum_error = picture_error(run.pictures.sum(run.pictures.bounces())).all();
    run.convergence.push_back(std::move(checkpoint));
    return run;
}

}  // namespace

std::optional<FieldRun> render_fields_once(const Scene& scene, const FieldSettings& settings,
                                           const std::function<bool()>& interrupted) {
    const Stopwatch watch;
    auto pictures = render_fields(scene, settings, interrupted);
    if (!pictures) return std::nullopt;
    return make_run(std::move(*pictures), settings, {}, watch.seconds());
}

FieldRun render_fields_to_error(const Scene& scene, FieldSettings settings, double relative_error, const RenderObserver& observer) {
    const Stopwatch watch;
    settings.patching.patches = fewest_patches;
    settings.rays = settings.light_samples = fewest_rays;
    settings.samples = 1;
    FieldRun run = *render_fields_once(scene, settings, [] { return false; });
    for (;;) {
        const auto& errors = run.convergence.back().term_error;
        const double worst = *std::max_element(errors.begin(), errors.end());
        observer.progress({run.pictures.samples, run.seconds, std::min(1.0, relative_error / worst), std::nullopt});
        if (worst <= relative_error) {
            run.outcome = Outcome::error_reached;
            return run;
        }
        if (!grow(settings, largest_parts(run.term_errors, settings.method), relative_error)) return run;
        auto next = render_fields(scene, settings, observer.interrupted);
        if (!next) {
            run.outcome = Outcome::interrupted;
            return run;
        }
        run = make_run(std::move(*next), settings, std::move(run.convergence), watch.seconds());
    }
}

}  // namespace neumann
