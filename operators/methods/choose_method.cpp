#include "operators/methods/choose_method.h"

#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "operators/correction/diffuse_sides.h"
#include "operators/methods/ahead.h"
#include "operators/methods/candidates.h"
#include "operators/methods/render.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

namespace {

constexpr std::uint64_t trial_stream = 0x747269616cull;  // another seed than the pictures'
constexpr int trial_width = 48, trial_bounces = 6;       // at most
constexpr std::uint64_t trial_samples = 64;
constexpr std::uint32_t trial_replicates = 4;

// Part of the work of the methods before it that a method may take to replace them: the pilot is no more exact than that.
constexpr double clearly_better = 0.8;
// Samples a pixel from which it pays to distribute them by a pilot.
constexpr double fewest_to_distribute = 32.0;
// The largest Σ_i E|error|² / |K^i Le|² of a pilot that is believed.
constexpr double largest_known_error = 1.0;
// Rays before the first sample are traced in order, without shading.
constexpr double price_of_setup = 0.3;

double square(const Image& image) {
    double sum = 0.0;
    for (const Rgb& x : image.pixels) sum += glm::dot(x, x);
    return sum;
}

struct Term {
    Image picture;
    double variance = 0.0;     // summed over the picture
    double least_light = 0.0;  // mean of the picture that is sure to be there
};
struct Result {
    double rays = 0.0, setup_rays = 0.0;
    std::vector<Term> terms;  // bounces 1 …
};

Result result_of(const BounceSeries& series) {
    Result result;
    result.rays = static_cast<double>(series.convergence.back().rays);
    result.setup_rays = static_cast<double>(series.rays) - result.rays;
    for (int i = 1; i <= series.bounces(); ++i) {
        PixelEstimate term = series.term(static_cast<std::size_t>(i));
        const MeanWithError& mean = series.report.bounces[static_cast<std::size_t>(i)].mean;
        result.terms.push_back({std::move(term.mean), square(term.standard_error), mean.mean - 2.0 * mean.standard_error});
    }
    return result;
}

// Σ_i E|error|² / |K^i Le|² of each method. A method that has not met the rare paths of a bounce sees neither their light nor their
// variance; so each is also compared with the one that is sure of most light. Bounces whose light nobody is sure of do not count.
std::vector<double> relative_errors(const std::vector<Result>& results) {
    std::vector<double> sums(results.size());
    for (std::size_t i = 0; i < results.front().terms.size(); ++i) {
        const Term& best = std::max_element(results.begin(), results.end(), [&](const Result& a, const Result& b) {
                               return a.terms[i].least_light < b.terms[i].least_light;
                           })->terms[i];
        const double light = square(best.picture) - best.variance;  // without bias
        if (best.least_light <= 0.0 || light <= 0.0) continue;
        for (std::size_t m = 0; m < results.size(); ++m) {
            const Term& term = results[m].terms[i];
            double difference = 0.0;
            for (std::size_t p = 0; p < term.picture.pixels.size(); ++p) {
                const Rgb d = term.picture.pixels[p] - best.picture.pixels[p];
                difference += glm::dot(d, d);
            }
            sums[m] += std::max(term.variance, difference - best.variance) / light;
        }
    }
    return sums;
}

Goal goal_of_trial(const Goal& goal, int bounces) {
    Goal trial;
    trial.bounces = bounces;
    trial.samples = trial_samples;
    trial.replicates = trial_replicates;
    trial.seed = goal.seed ^ trial_stream;
    trial.memory = goal.memory;
    trial.only_pictures = true;
    return trial;
}

// Where no method knows its terms after the pilot, their errors are made by rare paths, which the pilot may or may not have met.
MethodChoice by_the_lights(const method::Auto& open, const Scene& scene) {
    if (scene.emitters.has_environment() || scene.hide_emitters) {
        if (DiffuseSides(scene).empty())
            return {method::Guided{open},
                    "the pilot met too few of the paths to tell, and tables of directions find most light from afar"};
        return {method::Corrected{open},
                "the pilot met too few of the paths to tell, and fields on diffuse surfaces find most light from afar"};
    }
    return {method::Bidirectional{open},
            "the pilot met too few of the paths to tell, and walks from the lamps find most that are rare"};
}

}  // namespace

MethodChoice choose_method(const method::Auto& open, const Scene& scene, const Goal& goal, const Watch& watch) {
    const Stopwatch clock;
    const int bounces = std::min(goal.bounces.value_or(scene.bounces.value_or(trial_bounces)), trial_bounces);
    if (bounces == 0) return {method::Walk{open}, "the emitted light alone takes no walk"};
    const std::vector<Candidate> able = candidates(open, scene);
    if (able.size() == 1)
        return {able.front().method, "what mirrors and glass throw on from a light without extent is found from the light alone"};
    const double affordable = expected_rays(with_default_limits(goal), scene.film, bounces);
    if (affordable < rays_of_a_long_render) return {method::Walk{open}, "a pilot would take too large a part of so small a render"};

    const Scene small = scene.with(small_film(scene.film, trial_width));
    std::vector<Candidate> all;
    std::vector<Result> results;
    for (const Candidate& candidate : able) {
        if (watch.stop()) break;
        try {
            results.push_back(result_of(render(small, candidate.method, goal_of_trial(goal, bounces), {.stop = watch.stop})));
            all.push_back(candidate);
        } catch (const InputError&) {
            // Others refuse what the walk does not: a scene without surfaces has no patches.
            if (all.empty()) throw;
        } catch (const RunError&) {
            if (!watch.stop()) throw;
        }
    }
    if (watch.stop()) return {method::Walk{open}, "the pilot was interrupted"};

    const std::vector<double> errors = relative_errors(results);
    std::vector<double> works;
    for (std::size_t m = 0; m < all.size(); ++m) {
        const double left = 1.0 - price_of_setup * results[m].setup_rays / affordable;
        works.push_back(left > 0.0 ? errors[m] * results[m].rays * all[m].price / left : std::numeric_limits<double>::infinity());
    }
    std::size_t best = 0;
    for (std::size_t m = 1; m < all.size(); ++m)
        if (works[m] < clearly_better * works[best]) best = m;

    MethodChoice choice{all[best].method, "in a pilot it had no error"};
    std::vector<std::string> others;
    for (std::size_t m = 0; m < all.size(); ++m) {
        const double samples = static_cast<double>(trial_samples) * small.film.crop_width * small.film.crop_height;
        choice.trials.push_back({name_of(all[m].method), results[m].rays / samples, std::sqrt(errors[m])});
        if (m != best) others.push_back(fmt::format("{} {:.2g}", name_of(all[m].method), works[m] / works[best]));
    }
    if (works[best] > 0.0)
        choice.why = fmt::format("for the same error the others took, in a pilot: {} times its work", fmt::join(others, ", "));
    const MethodChoice other = by_the_lights(open, scene);
    const auto is_other = [&](const Candidate& candidate) { return candidate.method == other.method; };
    if (errors[best] > largest_known_error && std::any_of(all.begin(), all.end(), is_other)) {
        choice.method = other.method;
        choice.why = other.why;
    }
    const double samples = affordable / (rays_of_bounce * (bounces + 1.0) * scene.film.crop_width * scene.film.crop_height);
    if (samples >= fewest_to_distribute)
        std::visit(
            [](auto& m) {
                if constexpr (requires { m.adaptive; }) m.adaptive = LeastError::of_product;
            },
            choice.method);
    choice.seconds = clock.seconds();
    return choice;
}

}  // namespace neumann
