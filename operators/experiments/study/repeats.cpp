#include "operators/experiments/study/repeats.h"

#include "operators/experiments/study/picture_errors.h"
#include "operators/statistics/student_t.h"

#include <algorithm>
#include <cmath>

namespace neumann {

std::size_t repeats_for(double deviation, double half_width) {
    const auto is_enough = [&](std::size_t repeats) {
        const auto n = static_cast<double>(repeats);
        return 0.5 * student_t_quantile(0.95, n - 1.0) * deviation / std::sqrt(n) <= half_width;
    };
    std::size_t enough = 2, too_few = 1;
    for (; !is_enough(enough); enough *= 2) too_few = enough;
    while (enough - too_few > 1) {
        const std::size_t middle = too_few + (enough - too_few) / 2;
        (is_enough(middle) ? enough : too_few) = middle;
    }
    return enough;
}

std::optional<double> deviation_of_repeats(const std::vector<StudyMethod>& methods, int bounces, std::uint64_t seed,
                                           const Scene& scene, const Pilot& pilot, const Watch& watch) {
    constexpr std::uint64_t runs = 8;
    constexpr int level = 2;
    double most = 0.0;
    for (const StudyMethod& method : methods) {
        // The spread of the pictures does not depend on the reference.
        PictureErrors errors({Image(scene.film.crop_width, scene.film.crop_height), {}});
        for (std::uint64_t j = 0; j < runs; ++j) {
            const Effort effort = has_fields(method.method) ? field_effort(0) : sampling_effort(level);
            const auto run = run_method(method, effort, bounces, study_seed(seed, reference_method, 1, j), scene, pilot, watch);
            if (!run) return std::nullopt;
            errors.add(run->sum(static_cast<std::size_t>(bounces)).mean);
        }
        const WithError variance = errors.statistics().variance;
        if (variance.value > 0.0)
            most = std::max(most, std::sqrt(static_cast<double>(runs)) * variance.standard_error / variance.value);
    }
    return most;
}

}  // namespace neumann
