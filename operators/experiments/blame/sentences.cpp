#include "operators/experiments/blame/sentences.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann {

namespace {

// A suspect is named alone if the next one is less likely by this much.
constexpr double clear_lead = 10.0;

std::string title(const Scene& scene, std::uint32_t shape) {
    if (shape == SurfacePoint::infinity) return "what is beyond the surfaces";
    if (shape >= scene.origins.size()) return fmt::format("shape {}", shape);
    const Origin& origin = scene.origins[shape];
    return fmt::format("{} at {} ({})", origin.shape, to_string(origin.place), origin.bsdf);
}

std::string no_difference(const std::vector<TermVerdict>& terms) {
    double widest = 0.0;
    for (const TermVerdict& t : terms) widest = std::max(widest, t.test.ratio_error);
    return fmt::format(
        "No bounce differs: the means of all {} agree with ours within their errors, of which the largest is {:.1g} "
        "of a bounce, and so do their blocks of pixels.",
        terms.size(), widest);
}

bool refuted(const Suspect& suspect) { return suspect.p_of_all_that_is_left < 1e-6; }

bool is_one(const BounceRange& bounces) { return bounces.first == bounces.last; }

std::string named(const BounceRange& bounces) {
    std::string name = to_string(bounces);
    name[0] = 'B';
    return name;
}

// "; those before agree", or the ones that do not.
std::string those_before(const std::vector<TermVerdict>& terms, std::size_t wrong) {
    if (wrong == 0) return "";
    for (std::size_t i = 0; i < wrong; ++i)
        if (terms[i].doubt) return fmt::format("; of {} before it cannot be told", to_string(terms[i].bounces));
    return "; those before agree";
}

// The sentence for a term that is perhaps wrong, with the advice that would decide it.
std::string what_is_unclear(const TermVerdict& term, std::uint64_t samples) {
    const std::string is_apart =
        fmt::format("It cannot be told whether {} {} right: {} {:.4g} ± {:.2g} of our light", to_string(term.bounces),
                    is_one(term.bounces) ? "is" : "are", is_one(term.bounces) ? "it has" : "they have", term.test.ratio,
                    1.96 * term.test.ratio_error);
    switch (*term.doubt) {
        case TermVerdict::Doubt::few_samples:
            return fmt::format("{}, and there are not enough samples of ours, {} a pixel, to say why; more time or samples do.",
                               is_apart, samples);
        case TermVerdict::Doubt::shared_numbers:
            return fmt::format(
                "{}, too much or too little over wide areas, by more than your pixels' own noise, and no mistake that is tried "
                "explains it. Perhaps your pixels share random numbers; pictures of a second seed, given again, tell.",
                is_apart);
        case TermVerdict::Doubt::seeds_agree:
            return fmt::format(
                "{}, too much or too little over wide areas, by more than your pixels' own noise, and no mistake that is tried "
                "explains it. Your pictures of two seeds agree with each other: if all pixels have random numbers of their own, "
                "something is wrong that has no name here. More samples of yours tell.",
                is_apart);
        default:
            return fmt::format(
                "{}, and your pixels share random numbers: your pictures of two seeds differ from each other, too, over wide areas "
                "by more than their noise. Give each pixel numbers of its own.",
                is_apart);
    }
}

std::string which_bounce(const std::vector<TermVerdict>& terms, std::size_t first_wrong) {
    const TermVerdict& wrong = terms[first_wrong];
    const std::string chance = wrong.test.p < wrong.threshold
                                   ? fmt::format(" (by chance in 1 of {:.0g})", 1.0 / std::max(wrong.test.p, 1e-300))
                                   : ", in other places";
    const bool one = is_one(wrong.bounces);
    return fmt::format("{} {} the first to differ: {} {:.4g} ± {:.2g} of our light{}{}.", named(wrong.bounces), one ? "is" : "are",
                       one ? "it has" : "they have", wrong.test.ratio, 1.96 * wrong.test.ratio_error, chance,
                       those_before(terms, first_wrong));
}

// Whether the second suspect may be the cause as well: about as likely, and neither a mere description nor refuted where the first
// is not.
bool is_rival(const Suspect& best, const Suspect& next) {
    if (next.misfit - best.misfit >= clear_lead) return false;
    return refuted(best) || (!refuted(next) && (best.is_fitted || !next.is_fitted));
}

std::string what_it_looks_like(const Suspect& best, const Suspect& next) {
    return fmt::format("It looks as if {}{}{}.", best.words, refuted(best) ? ", which explains most but not all of it" : "",
                       is_rival(best, next) ? fmt::format("; or {}", next.words) : "");
}

std::string where_it_is(const ShapeShare& most, const Scene& scene) {
    return fmt::format("{:.0f}% of the squared difference is on {}, which has {:.3g} of our light.", 100.0 * most.share,
                       title(scene, most.shape), most.ratio);
}

}  // namespace

std::vector<std::string> sentences_about(const Blame& blame, const Scene& scene) {
    std::vector<std::string> say;
    if (blame.first_wrong) {
        say.push_back(which_bounce(blame.terms, *blame.first_wrong));
        say.push_back(what_it_looks_like(blame.suspects[0], blame.suspects[1]));
        say.push_back(where_it_is(blame.shapes[0], scene));
    } else if (const TermVerdict* doubtful = blame.first_doubtful()) {
        say.push_back(what_is_unclear(*doubtful, blame.samples));
    } else {
        say.push_back(no_difference(blame.terms));
    }
    if (blame.counting_by_the_data)
        say.push_back(fmt::format("The pictures' means look as if depths were counted as {} does, not as {}.",
                                  name_of(*blame.counting_by_the_data), name_of(blame.counting)));
    if (!blame.knows_their_noise)
        say.push_back("Their noise was judged by the pictures themselves; those of a second seed would tell it.");
    return say;
}

}  // namespace neumann
