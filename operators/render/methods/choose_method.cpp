#include "operators/render/methods/choose_method.h"

#include "core/base/stopwatch.h"
#include "operators/paths/corrected/diffuse_sides.h"
#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/methods/ahead.h"
#include "operators/render/methods/candidates.h"
#include "operators/render/methods/method_pilot.h"
#include "operators/render/methods/preparation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace neumann {

namespace {

constexpr std::uint64_t trial_stream = 0x747269616cull;  // differs from the seed of the pictures
constexpr std::uint64_t second_stream = 0x616761696eull;
constexpr int trial_width = 48, least_trial_width = 16, trial_bounces = 6;  // upper limits
constexpr std::uint64_t first_trial_samples = 64, fewest_trial_samples = 16;
constexpr std::uint32_t trial_replicates = 4;
// If no method knows its terms, the pilot is repeated with `longer` times as many samples, up to this part of the rays
// that the goal affords.
constexpr std::uint64_t longer = 4;
constexpr double part_of_render = 0.05;
// The part of the seconds that a method's preparation for its pilot may take; it is lost if another method is taken.
constexpr double part_of_preparation = 1.0 / 12.0;
// Pilots that are foretold to take this part of their seconds have room to take longer.
constexpr double caution = 0.7;

// A method replaces those before it if it takes at most this part of their work: the pilot is no more exact than that.
constexpr double clearly_better = 0.8;
// From this number of samples a pixel on it pays to distribute them by a pilot.
constexpr double fewest_to_distribute = 32.0;
// The largest Σ_i E|error|² / |K^i Le|² of a pilot that is believed.
constexpr double largest_known_error = 1.0;
// Guided walks take at least about this part of the walk's work, and their tables are half of the cost of pilots. So
// they have a pilot only if no other method takes less work, and if these rays and those of the other pilots are a
// small part of the render. (Among the scenes in scenes/ the smallest part is 0.49; apps/manual/measurements.md.)
constexpr double work_of_guided = 0.4, rays_of_tables = 4.5e6;
// The rays for the shared points of `corrected` in a pilot, however small its film is.
constexpr double rays_of_points = 130'000.0;

struct TrialSize {
    int width = trial_width;
    std::uint64_t samples = first_trial_samples;
};

Goal goal_of_trial(const Goal& goal, int bounces, const TrialSize& size) {
    Goal trial;
    trial.bounces = bounces;
    trial.samples = size.samples;
    trial.replicates = trial_replicates;
    trial.seed = goal.seed ^ trial_stream;
    trial.memory = goal.memory;
    trial.only_pictures = true;
    return trial;
}

// Whether `corrected`, as it is prepared, has paths from the lamps for what glass and mirrors throw on.
bool makes_caustics(const Prepared& prepared) {
    const auto made = prepared.of(method::Corrected::name);
    return made && made->splats();
}

// The method for scenes in which no method knows its terms after the pilot: their errors are made by rare paths, which
// the pilot may or may not have met. The kind of lights decides.
MethodChoice by_the_lights(const method::Auto& open, const Scene& scene, const Prepared& prepared) {
    if (makes_caustics(prepared))
        return {method::Corrected{open},
                "what mirrors and glass throw on is rare: paths from the lamps find it, as fields find the rest, and no other "
                "method was clearly "
                "better twice"};
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

void set_adaptive(Method& method, LeastError least) {
    std::visit(
        [&](auto& m) {
            if constexpr (requires { m.adaptive; }) m.adaptive = least;
        },
        method);
}

MethodTrial described(const MethodPilot& trial, double error) {
    return {name_of(trial.candidate.method), trial.rays / trial.samples, std::sqrt(error)};
}

// Takes a method with a bias if its error after the work of `choice` is clearly smaller. `work`: for a squared error of 1.
void allow_bias(MethodChoice& choice, double work, const std::vector<MethodPilot>& known, const Scene& small, const Goal& goal,
                double affordable, const Goal& of_trial, Prepared& prepared, const Watch& watch) {
    if (!(work > 0.0)) return;
    const double to_goal = goal.relative_error ? work / (*goal.relative_error * *goal.relative_error) : affordable;
    const double rays = std::min(affordable, to_goal), error = work / rays;
    const std::string unbiased = name_of(choice.method);
    double least = clearly_better * error;
    const std::vector<MethodPilot> trials = make_pilots(biased_candidates(), small, of_trial, prepared, watch, true);
    if (watch.stop()) choice.why += "; methods with a bias were left out: their pilots would take too long";
    for (const MethodPilot& trial : trials) {
        const double of_pilot = error_with_bias(trial, known);
        choice.trials.push_back(described(trial, of_pilot));
        // Without a number of samples fields refine patches, rays and samples together, and their errors fall about as
        // 1/√rays; with one they stay as they are.
        const double expected = goal.samples ? of_pilot : of_pilot * trial.rays * trial.candidate.price / rays;
        if (expected >= least) continue;
        least = expected;
        choice.method = trial.candidate.method;
        choice.why = fmt::format("by a pilot its error, with its bias, is {:.2g} of that of {}, which has none, for the same work",
                                 std::sqrt(expected / error), unbiased);
    }
}

// The promises of the trials: Σ_i E|error|² / |K^i Le|², the work for an error of 1, and the index of the best.
struct Promise {
    std::vector<double> errors, works;
    std::size_t best = 0;
};
Promise promise_of(const std::vector<MethodPilot>& trials) {
    Promise p;
    for (const MethodPilot& trial : trials) {
        p.errors.push_back(unbiased_error(trial, trials));
        p.works.push_back(p.errors.back() * trial.rays * trial.candidate.price);
    }
    for (std::size_t m = 1; m < trials.size(); ++m)
        if (p.works[m] < clearly_better * p.works[p.best]) p.best = m;
    return p;
}

// Divides the time of a render with a time limit among pilots and pictures.
class TimeLimit {
public:
    // `bounces`: of the pilots.
    TimeLimit(const Scene& scene, double seconds, const Pilot& pilot, int bounces)
        : scene_(scene), pilot_(pilot), preparations_(scene, pilot), seconds_(seconds), bounces_(bounces) {}

    double of_pilots() const { return part_of_render * seconds_; }
    // The samples a pixel that there is time for: by the walk up to bounce N, or with these rays at this price.
    double samples_of_walk(int N) const { return seconds_ / (pixels_of(scene_.film) * pilot_.seconds_per_walk(N)); }
    double samples(double rays, double price) const {
        return seconds_ / (pixels_of(scene_.film) * rays * price * pilot_.seconds_per_ray());
    }

    // The seconds of all pilots and of the preparations of these methods, which may be foretold wrongly by a half.
    double of_all(const std::vector<Candidate>& able) const {
        double seconds = of_pilots();
        for (const Candidate& candidate : able) seconds += 1.5 * preparations_.of(candidate.method).seconds;
        return seconds;
    }

    // Makes preparations that take too long smaller, and removes methods that still take too long. Returns the reasons.
    std::string leave_out(std::vector<Candidate>& able) const {
        std::string reasons;
        std::vector<Candidate> fit;
        for (Candidate& candidate : able) {
            const Preparation whole = preparations_.of(candidate.method);
            const auto method = preparations_.fitting(part_of_preparation * seconds_, candidate.method);
            if (!method) {
                reasons += fmt::format("; {} was left out: {}", name_of(candidate.method), describe(whole));
                continue;
            }
            if (const Preparation fits = preparations_.of(*method); fits.rays < whole.rays)
                reasons += fmt::format("; {} was made smaller, of {:.0f} patches and {:.2g} rays: {}", name_of(candidate.method),
                                       fits.facets, fits.rays, describe(whole));
            candidate.method = *method;
            fit.push_back(std::move(candidate));
        }
        able = std::move(fit);
        return reasons;
    }
    TrialSize size_of_trials(const std::vector<Candidate>& able) const {
        TrialSize size;
        const auto takes_too_long = [&] {
            const double walks = pixels_of(small_film(scene_.film, size.width)) * static_cast<double>(size.samples);
            double seconds = 0.0;
            for (const Candidate& candidate : able)
                seconds += walks * pilot_.seconds_per_walk(bounces_) * candidate.price + seconds_of_points(candidate.method);
            return seconds > caution * of_pilots();
        };
        while (size.width > least_trial_width && takes_too_long()) size.width = std::max(size.width * 3 / 4, least_trial_width);
        while (size.samples > fewest_trial_samples && takes_too_long()) size.samples /= 2;
        return size;
    }

private:
    double seconds_of_points(const Method& method) const {
        return std::holds_alternative<method::Corrected>(method) ? trial_replicates * rays_of_points * pilot_.seconds_per_ray()
                                                                 : 0.0;
    }
    static double pixels_of(const Film& film) { return static_cast<double>(film.crop_width) * film.crop_height; }

    const Scene& scene_;
    const Pilot& pilot_;
    Preparations preparations_;
    double seconds_;
    int bounces_;
};

// The pilots of the able methods, and their promises.
struct Trials {
    Goal goal;  // the goal of each pilot
    std::vector<MethodPilot> pilots;
    Promise promise;

    bool is_known() const { return promise.errors[promise.best] <= largest_known_error; }
};

// Runs the pilots. If `watch` stops them, returns those of the methods that have had one; nothing if only the walk has.
std::optional<Trials> try_methods(std::vector<Candidate> able, const Scene& small, const Goal& goal, double affordable,
                                  Prepared& prepared, const Watch& watch) {
    const auto is_guided = [](const Candidate& c) { return std::holds_alternative<method::Guided>(c.method); };
    std::vector<Candidate> guided;
    std::ranges::copy_if(able, std::back_inserter(guided), is_guided);
    std::erase_if(able, is_guided);
    const double most = part_of_render * affordable;
    std::optional<Trials> before;
    for (Trials trials{goal, {}, {}};; trials.goal.samples = *trials.goal.samples * longer) {
        auto& [goal_of_pilots, pilots, promise] = trials;
        pilots = make_pilots(able, small, goal_of_pilots, prepared, watch, false);
        if (watch.stop() && (before || pilots.size() < 2)) return before;
        promise = promise_of(pilots);
        if (watch.stop()) return trials;
        before = trials;
        if (rays_of(pilots) + rays_of_tables <= most && promise.works[promise.best] > work_of_guided * promise.works.front()) {
            std::ranges::move(make_pilots(guided, small, goal_of_pilots, prepared, watch, true), std::back_inserter(pilots));
            if (watch.stop()) return before;
            promise = promise_of(pilots);
        }
        if (trials.is_known() || static_cast<double>(longer) * rays_of(pilots) > most) return trials;
    }
}

// Whether `one` takes clearly less work than `other`, also in pilots of another seed.
bool is_better_twice(std::size_t one, std::size_t other, const Trials& trials, const Scene& small, Prepared& prepared,
                     const Watch& watch) {
    if (trials.promise.works[one] >= clearly_better * trials.promise.works[other]) return false;
    Goal goal = trials.goal;
    goal.seed ^= second_stream;
    const std::vector<MethodPilot> again =
        make_pilots({trials.pilots[one].candidate, trials.pilots[other].candidate}, small, goal, prepared, watch, true);
    if (again.size() < 2) return false;
    const Promise promise = promise_of(again);
    return promise.works[0] < clearly_better * promise.works[1];
}

MethodChoice choose(const method::Auto& open, const Scene& scene, const Goal& goal, const PilotOnDemand& pilot, Prepared& prepared,
                    const Watch& watch) {
    const int N = choose_bounces(goal, scene, pilot), bounces = std::min(N, trial_bounces);
    if (bounces == 0) return {method::Walk{open}, "the emitted light alone takes no walk"};
    std::vector<Candidate> able = candidates(open, scene);
    if (able.size() == 1)
        return {able.front().method, "what mirrors and glass throw on from a light without extent is found from the light alone"};
    const Goal limits = with_default_limits(goal);
    const double affordable = expected_rays(limits, scene.film, bounces);
    if (affordable < rays_of_a_long_render) return {method::Walk{open}, "a pilot would take too large a part of so small a render"};

    const Stopwatch clock;
    std::optional<TimeLimit> time;
    std::string left_out;
    TrialSize size;
    if (limits.seconds) {
        time.emplace(scene, *limits.seconds, pilot(), bounces);
        const double samples = time->samples_of_walk(N);
        if (samples < fewest_replicates)
            return {method::Walk{open},
                    fmt::format("in so short a time, {:.2g} samples a pixel of the walk, no other makes more", samples)};
        left_out = time->leave_out(able);
        if (able.size() == 1) return {method::Walk{open}, "it needs no preparation" + left_out};
        size = time->size_of_trials(able);
    }
    const double seconds_of_pilots = time ? time->of_all(able) : 0.0;
    const Watch of_pilots{.stop = [&] { return watch.stop() || (time && clock.seconds() > seconds_of_pilots); }};
    const Scene small = scene.with(small_film(scene.film, size.width));
    const std::optional<Trials> trials =
        try_methods(able, small, goal_of_trial(goal, bounces, size), affordable, prepared, of_pilots);
    const MethodChoice interrupted{method::Walk{open},
                                   watch.stop() ? "the pilot was interrupted"
                                                : "a pilot of the others would take more than a twentieth of the time" + left_out};
    if (!trials || watch.stop()) return interrupted;
    const std::vector<MethodPilot>& pilots = trials->pilots;
    const auto& [errors, works, best] = trials->promise;

    std::size_t taken = best;
    std::string why = "in a pilot it had no error";
    std::vector<std::string> others;
    for (std::size_t m = 0; m < pilots.size(); ++m)
        if (m != best) others.push_back(fmt::format("{} {:.2g}", name_of(pilots[m].candidate.method), works[m] / works[best]));
    if (works[best] > 0.0)
        why = fmt::format("for the same error the others took, in a pilot: {} times its work", fmt::join(others, ", "));

    const MethodChoice by_lights = by_the_lights(open, scene, prepared);
    const auto of_lights =
        static_cast<std::size_t>(std::ranges::find(pilots, by_lights.method.index(),
                                                   [](const MethodPilot& pilot) { return pilot.candidate.method.index(); }) -
                                 pilots.begin());
    // Where mirrors or glass show what glass throws on, pilots may meet none of it and seem to know all.
    if ((!trials->is_known() || (makes_caustics(prepared) && best > 0)) && of_lights != best && of_lights < pilots.size()) {
        // The walk, which is the first pilot, meets the fewest rare paths.
        if (best > 0 && is_better_twice(best, of_lights, *trials, small, prepared, of_pilots)) {
            why = fmt::format("rare paths decide, and in two pilots {} took clearly more work than it", name_of(by_lights.method));
        } else {
            taken = of_lights;
            why = by_lights.why;
        }
        if (watch.stop()) return interrupted;
    }
    const MethodPilot& best_pilot = pilots[taken];
    const double samples = time ? time->samples(best_pilot.rays / best_pilot.samples, best_pilot.candidate.price)
                                : affordable / (rays_of_bounce * (bounces + 1.0) * scene.film.crop_width * scene.film.crop_height);
    if (time && taken > 0 && samples < fewest_replicates)
        return {method::Walk{open},
                fmt::format("{} has time for {:.2g} samples a pixel alone", name_of(best_pilot.candidate.method), samples)};
    MethodChoice choice{best_pilot.candidate.method, why + left_out};
    for (std::size_t m = 0; m < pilots.size(); ++m) choice.trials.push_back(described(pilots[m], errors[m]));
    // Fields support only linear RGB and no parts, and choose their samples themselves if an error is to be reached.
    const bool fields_can = !goal.colors && !goal.part && !(goal.samples && goal.relative_error);
    if (open.bias_allowed && fields_can)
        allow_bias(choice, works[taken], pilots, small, goal, affordable, goal_of_trial(goal, bounces, size), prepared, of_pilots);
    if (samples >= fewest_to_distribute && !std::holds_alternative<method::Corrected>(choice.method))
        set_adaptive(choice.method, LeastError::of_all);
    return choice;
}

}  // namespace

MethodChoice choose_method(const method::Auto& open, const Scene& scene, const Goal& goal, const PilotOnDemand& pilot,
                           Prepared& prepared, const Watch& watch) {
    const Stopwatch clock;
    MethodChoice choice = choose(open, scene, goal, pilot, prepared, watch);
    if (open.adaptive) set_adaptive(choice.method, *open.adaptive);
    if (!choice.trials.empty()) choice.seconds = clock.seconds();
    return choice;
}

}  // namespace neumann
