#include "operators/pictures/field_goal.h"

#include "core/base/memory.h"
#include "core/base/stopwatch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace neumann {

namespace {

constexpr std::size_t fewest_patches = 500, most_patches = 250'000;
constexpr std::uint32_t fewest_rays = 16, most_samples = 1024, most_light_samples = 64;
constexpr std::uint32_t pilot_samples = 4;
// A step multiplies no part by more than this: estimates from few samples are rough.
constexpr double most_growth = 8.0;
// Of the table of T.
constexpr double part_of_memory = 0.05;

double square(double x) { return x * x; }

std::uint32_t most_rays(std::size_t patches) {
    const double entries = part_of_memory * physical_memory() / sizeof(std::uint32_t);
    return std::bit_floor(static_cast<std::uint32_t>(std::max(1.0 * fewest_rays, entries / static_cast<double>(patches))));
}

std::uint32_t grow(std::uint32_t n, double factor, std::uint32_t most) {
    const auto times = std::bit_ceil(static_cast<std::uint32_t>(std::ceil(std::clamp(factor, 1.0, most_growth))));
    return std::max(n, std::min(most, n * times));
}

// What the error of each term is made of: camera samples are a part of its square like 1 / samples, rays of the fields another one
// like 1 / rays; patches are like a power of their number.
class ErrorParts {
public:
    // From two renders of which the second has more samples only.
    ErrorParts(FieldMethod method, const std::vector<PictureError>& few, const std::vector<PictureError>& many, double times) {
        for (std::size_t i = 0; i < few.size(); ++i) {
            const bool at_pixel = i < 2 && !shows_patches(method);
            const double fallen = (square(few[i].sampling) - square(many[i].sampling)) * times / (times - 1.0);
            by_samples_.push_back(at_pixel ? std::numeric_limits<double>::infinity()
                                           : std::clamp(fallen, 0.0, square(few[i].sampling)));
        }
    }

    // More of what makes the errors of a render; false where nothing can grow any more.
    bool grow(FieldSettings& settings, const std::vector<PictureError>& errors, double target) {
        const FieldSettings before = settings;
        const double part = 0.5 * square(target);  // for sampling; and for patches
        double samples = 1.0, rays = 1.0, patches = 1.0;
        for (std::size_t i = 0; i < errors.size(); ++i) {
            const double all = square(errors[i].sampling), own = std::min(all, by_samples_[i] / settings.samples);
            const bool only_samples = own == all;
            samples = std::max(samples, own / (only_samples ? part : 0.5 * part));
        }
        settings.samples = neumann::grow(settings.samples, samples, most_samples);
        for (std::size_t i = 0; i < errors.size(); ++i) {
            const double all = square(errors[i].sampling), own = std::min(all, by_samples_[i] / before.samples);
            const double left = part - by_samples_[i] / settings.samples;
            rays = std::max(rays, (all - own) / std::max(left, 0.5 * part));
            patches = std::max(patches, std::pow(square(errors[i].discretisation) / part, 0.5 / order(i, errors, before)));
        }
        settings.patching.patches = std::min(
            most_patches, static_cast<std::size_t>(static_cast<double>(before.patching.patches) * std::min(patches, most_growth)));
        settings.rays = neumann::grow(settings.rays, rays, most_rays(settings.patching.patches));
        settings.light_samples = std::min(settings.rays, most_light_samples);
        if (settings.patching.patches != before.patching.patches) {
            errors_before_ = errors;
            patches_before_ = before.patching.patches;
        }
        return settings.samples != before.samples || settings.rays != before.rays ||
               settings.patching.patches != before.patching.patches;
    }

private:
    // Of the error in the number of patches, as the last two renders show it: 1 where it is that of linear interpolation, 1/2
    // beside edges.
    double order(std::size_t i, const std::vector<PictureError>& errors, const FieldSettings& settings) const {
        if (errors_before_.empty() || errors[i].discretisation == 0.0) return 0.5;
        return std::clamp(std::log(errors_before_[i].discretisation / errors[i].discretisation) /
                              std::log(static_cast<double>(settings.patching.patches) / static_cast<double>(patches_before_)),
                          0.5, 1.0);
    }

    std::vector<double> by_samples_;  // times the number of samples
    std::vector<PictureError> errors_before_;
    std::size_t patches_before_ = 0;
};

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
    std::optional<ErrorParts> parts;
    for (;;) {
        const auto& errors = run.convergence.back().term_error;
        const double worst = *std::max_element(errors.begin(), errors.end());
        observer.progress({run.pictures.samples, run.seconds, std::min(1.0, relative_error / worst), std::nullopt});
        if (worst <= relative_error) {
            run.outcome = Outcome::error_reached;
            return run;
        }
        const std::vector<PictureError> before = run.term_errors;
        if (!parts)
            settings.samples = pilot_samples;
        else if (!parts->grow(settings, before, relative_error))
            return run;
        auto next = render_fields(scene, settings, observer.interrupted);
        if (!next) {
            run.outcome = Outcome::interrupted;
            return run;
        }
        run = make_run(std::move(*next), settings, std::move(run.convergence), watch.seconds());
        if (!parts) parts.emplace(settings.method, before, run.term_errors, pilot_samples);
    }
}

}  // namespace neumann
