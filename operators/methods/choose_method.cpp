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
#include <iterator>
#include <limits>

namespace neumann {

namespace {

constexpr std::uint64_t trial_stream = 0x747269616cull;  // another seed than the pictures'
constexpr std::uint64_t second_stream = 0x616761696eull;
constexpr int trial_width = 48, trial_bounces = 6;  // at most
constexpr std::uint64_t first_trial_samples = 64;
constexpr std::uint32_t trial_replicates = 4;
// Where no method knows its terms, the pilot has so many times as many samples, again and again, up to this part of the rays that
// the goal affords.
constexpr std::uint64_t longer = 4;
constexpr double part_of_render = 0.05;

// A difference shows more than the errors that are stated, if its square is so many times as large.
constexpr double clearly_more = 2.0;
// Part of the work of the methods before it that a method may take to replace them: the pilot is no more exact than that.
constexpr double clearly_better = 0.8;
// Samples a pixel from which it pays to distribute them by a pilot.
constexpr double fewest_to_distribute = 32.0;
// The largest Σ_i E|error|² / |K^i Le|² of a pilot that is believed.
constexpr double largest_known_error = 1.0;
// Guided walks take at least about so much of the walk's work, and their tables are half of what pilots cost. So they have a pilot
// where no other method takes less, and where these rays and those of the others' pilots are a small part of the render. (Of the
// scenes in scenes/, 0.49 where they gain most; apps/manual/methods.md.)
constexpr double work_of_guided = 0.4, rays_of_tables = 4.5e6;
// Rays before the first sample are traced in order, without shading.
constexpr double price_of_setup = 0.3;

double square(const Image& image) {
    double sum = 0.0;
    for (const Rgb& x : image.pixels) sum += glm::dot(x, x);
    return sum;
}

struct Term {
    Image picture;
    double variance = 0.0;      // summed over the picture
    double squared_bias = 0.0;  // the same
    double least_light = 0.0;   // mean of the picture that is sure to be there

    double light() const { return square(picture) - variance; }  // |K^i Le|², without bias
};
struct Result {
    double samples = 0.0, rays = 0.0, setup_rays = 0.0;
    std::vector<Term> terms;  // bounces 1 …
};

Result result_of(const BounceSeries& series) {
    Result result;
    result.rays = static_cast<double>(series.convergence.back().rays);
    result.setup_rays = static_cast<double>(series.rays) - result.rays;
    for (int i = 1; i <= series.bounces(); ++i) {
        PixelEstimate term = series.term(static_cast<std::size_t>(i));
        const MeanWithError& mean = series.report.bounces[static_cast<std::size_t>(i)].mean;
        result.terms.push_back({std::move(term.mean), square(term.standard_error), square(term.discretisation),
                                mean.mean - 2.0 * mean.standard_error});
    }
    result.samples = static_cast<double>(series.samples * result.terms.front().picture.pixels.size());
    return result;
}

struct Trial {
    Candidate candidate;
    Result result;
};

// Errors of bounces whose light nobody of `known` is sure of do not count.
const Term* surest(const std::vector<Trial>& known, std::size_t i) {
    const Term* best = &known.front().result.terms[i];
    for (const Trial& trial : known)
        if (trial.result.terms[i].least_light > best->least_light) best = &trial.result.terms[i];
    return best->least_light > 0.0 && best->light() > 0.0 ? best : nullptr;
}
// Σ|a − b|², of which the variances of both are a part.
double square_of_difference(const Term& a, const Term& b) {
    double sum = 0.0;
    for (std::size_t p = 0; p < a.picture.pixels.size(); ++p) {
        const Rgb d = a.picture.pixels[p] - b.picture.pixels[p];
        sum += glm::dot(d, d);
    }
    return sum;
}

// Σ_i error_of(term, best) / |K^i Le|², where `best` is the term that is surest.
template <class F>
double relative_error(const Result& result, const std::vector<Trial>& known, const F& error_of) {
    double sum = 0.0;
    for (std::size_t i = 0; i < result.terms.size(); ++i)
        if (const Term* best = surest(known, i)) sum += error_of(result.terms[i], *best) / best->light();
    return sum;
}
// E|error|² of a method without bias. One that has not met the rare paths of a bounce sees neither their light nor their variance;
// so it is also compared with that of `known` which is sure of most light.
double error_of(const Term& term, const Term& best) {
    return std::max(term.variance, square_of_difference(term, best) - best.variance);
}
// The same of a method with a bias, which counts as it states it, or as the pictures of `known` show it, where that is clearly
// more.
double error_with_bias(const Term& term, const Term& best) {
    const double stated = term.variance + term.squared_bias, shown = square_of_difference(term, best);
    return shown > clearly_more * (stated + best.variance) ? shown - best.variance : stated;
}

Goal goal_of_trial(const Goal& goal, int bounces) {
    Goal trial;
    trial.bounces = bounces;
    trial.samples = first_trial_samples;
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

// What a method does in a pilot; nothing if it refuses the scene, unless it is the first, which refuses for all.
std::vector<Trial> pilots_of(const std::vector<Candidate>& all, const Scene& small, const Goal& goal, const Watch& watch,
                             bool may_refuse) {
    std::vector<Trial> trials;
    for (const Candidate& candidate : all) {
        if (watch.stop()) break;
        try {
            trials.push_back({candidate, result_of(render(small, candidate.method, goal, {.stop = watch.stop}))});
        } catch (const InputError&) {
            // A scene without surfaces has no patches.
            if (trials.empty() && !may_refuse) throw;
        } catch (const RunError&) {
            if (!watch.stop()) throw;
        }
    }
    return trials;
}

void set_adaptive(Method& method, LeastError least) {
    std::visit(
        [&](auto& m) {
            if constexpr (requires { m.adaptive; }) m.adaptive = least;
        },
        method);
}

MethodTrial described(const Trial& trial, double error) {
    return {name_of(trial.candidate.method), trial.result.rays / trial.result.samples, std::sqrt(error)};
}

// Takes a method with a bias, if its error after the work of `choice` is clearly smaller. `work`: for a squared error of 1.
void allow_bias(MethodChoice& choice, double work, const std::vector<Trial>& known, const Scene& small, const Goal& goal,
                double affordable, const Goal& of_trial, const Watch& watch) {
    if (!(work > 0.0)) return;
    const double to_goal = goal.relative_error ? work / (*goal.relative_error * *goal.relative_error) : affordable;
    const double rays = std::min(affordable, to_goal), error = work / rays;
    const std::string unbiased = name_of(choice.method);
    double least = clearly_better * error;
    for (const Trial& trial : pilots_of(biased_candidates(), small, of_trial, watch, true)) {
        const double of_pilot = relative_error(trial.result, known, error_with_bias);
        choice.trials.push_back(described(trial, of_pilot));
        // Without a number of samples they refine patches, rays and samples together, and their errors fall about as 1/√rays; with
        // one they stay as they are.
        const double expected = goal.samples ? of_pilot : of_pilot * trial.result.rays * trial.candidate.price / rays;
        if (expected >= least) continue;
        least = expected;
        choice.method = trial.candidate.method;
        choice.why = fmt::format("by a pilot its error, with its bias, is {:.2g} of that of {}, which has none, for the same work",
                                 std::sqrt(expected / error), unbiased);
    }
}

// What trials promise: Σ_i E|error|² / |K^i Le|², and the work for an error of 1, of each; and the method that is taken.
struct Promise {
    std::vector<double> errors, works;
    std::size_t best = 0;
};
Promise promise_of(const std::vector<Trial>& trials, double affordable) {
    Promise p;
    for (const Trial& trial : trials) {
        const double left = 1.0 - price_of_setup * trial.result.setup_rays / affordable;
        p.errors.push_back(relative_error(trial.result, trials, error_of));
        p.works.push_back(left > 0.0 ? p.errors.back() * trial.result.rays * trial.candidate.price / left
                                     : std::numeric_limits<double>::infinity());
    }
    for (std::size_t m = 1; m < trials.size(); ++m)
        if (p.works[m] < clearly_better * p.works[p.best]) p.best = m;
    return p;
}

double rays_of(const std::vector<Trial>& trials) {
    double rays = 0.0;
    for (const Trial& trial : trials) rays += trial.result.rays;
    return rays;
}

// Whether a pilot of another seed finds the same. (In glass-ball one in four finds `corrected` better than `bidirectional`.)
bool is_better_again(const Candidate& one, const Candidate& other, const Scene& small, Goal goal, double affordable,
                     const Watch& watch) {
    goal.seed ^= second_stream;
    const std::vector<Trial> trials = pilots_of({one, other}, small, goal, watch, true);
    if (trials.size() < 2) return false;
    const Promise promise = promise_of(trials, affordable);
    return promise.works[0] < clearly_better * promise.works[1];
}

bool is_guided(const Candidate& candidate) { return std::holds_alternative<method::Guided>(candidate.method); }

MethodChoice choose(const method::Auto& open, const Scene& scene, const Goal& goal, const Watch& watch) {
    const int bounces = std::min(goal.bounces.value_or(scene.bounces.value_or(trial_bounces)), trial_bounces);
    if (bounces == 0) return {method::Walk{open}, "the emitted light alone takes no walk"};
    std::vector<Candidate> able = candidates(open, scene);
    if (able.size() == 1)
        return {able.front().method, "what mirrors and glass throw on from a light without extent is found from the light alone"};
    std::vector<Candidate> guided;
    std::ranges::copy_if(able, std::back_inserter(guided), is_guided);
    std::erase_if(able, is_guided);
    const double affordable = expected_rays(with_default_limits(goal), scene.film, bounces);
    if (affordable < rays_of_a_long_render) return {method::Walk{open}, "a pilot would take too large a part of so small a render"};

    const Scene small = scene.with(small_film(scene.film, trial_width));
    Goal of_trial = goal_of_trial(goal, bounces);
    std::vector<Trial> trials;
    Promise promise;
    for (;; of_trial.samples = *of_trial.samples * longer) {
        trials = pilots_of(able, small, of_trial, watch, false);
        if (watch.stop()) return {method::Walk{open}, "the pilot was interrupted"};
        promise = promise_of(trials, affordable);
        const double most = part_of_render * affordable;
        if (rays_of(trials) + rays_of_tables <= most && promise.works[promise.best] > work_of_guided * promise.works.front()) {
            std::ranges::move(pilots_of(guided, small, of_trial, watch, true), std::back_inserter(trials));
            if (watch.stop()) return {method::Walk{open}, "the pilot was interrupted"};
            promise = promise_of(trials, affordable);
        }
        if (promise.errors[promise.best] <= largest_known_error || static_cast<double>(longer) * rays_of(trials) > most) break;
    }
    const auto& [errors, works, best] = promise;

    MethodChoice choice{trials[best].candidate.method, "in a pilot it had no error"};
    std::vector<std::string> others;
    for (std::size_t m = 0; m < trials.size(); ++m) {
        choice.trials.push_back(described(trials[m], errors[m]));
        if (m != best) others.push_back(fmt::format("{} {:.2g}", name_of(trials[m].candidate.method), works[m] / works[best]));
    }
    if (works[best] > 0.0)
        choice.why = fmt::format("for the same error the others took, in a pilot: {} times its work", fmt::join(others, ", "));
    const MethodChoice other = by_the_lights(open, scene);
    const auto of_lights = static_cast<std::size_t>(
        std::ranges::find(trials, other.method, [](const Trial& trial) { return trial.candidate.method; }) - trials.begin());
    if (errors[best] > largest_known_error && of_lights != best && of_lights < trials.size()) {
        const bool is_clear =
            best > 0 && works[best] < clearly_better * works[of_lights] &&
            is_better_again(trials[best].candidate, trials[of_lights].candidate, small, of_trial, affordable, watch);
        if (!is_clear) choice.method = other.method;
        choice.why =
            is_clear ? fmt::format("rare paths decide, and in two pilots {} took clearly more work than it", name_of(other.method))
                     : other.why;
    }
    // Fields have linear RGB alone and no parts, and choose their samples by themselves where an error is to be reached.
    const bool fields_can = !goal.colors && !goal.part && !(goal.samples && goal.relative_error);
    if (open.bias_allowed && fields_can)
        allow_bias(choice, works[best], trials, small, goal, affordable, goal_of_trial(goal, bounces), watch);
    const double samples = affordable / (rays_of_bounce * (bounces + 1.0) * scene.film.crop_width * scene.film.crop_height);
    if (samples >= fewest_to_distribute) set_adaptive(choice.method, LeastError::of_all);
    return choice;
}

}  // namespace

MethodChoice choose_method(const method::Auto& open, const Scene& scene, const Goal& goal, const Watch& watch) {
    const Stopwatch clock;
    MethodChoice choice = choose(open, scene, goal, watch);
    if (open.adaptive) set_adaptive(choice.method, *open.adaptive);
    if (!choice.trials.empty()) choice.seconds = clock.seconds();
    return choice;
}

}  // namespace neumann
