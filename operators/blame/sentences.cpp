#include "operators/blame/sentences.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann {

namespace {

// A suspect is named alone if the next is so much less likely.
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

std::string which_bounce(const TermVerdict& wrong, bool is_first) {
    std::string bounces = to_string(wrong.bounces);
    bounces[0] = 'B';
    const bool is_one = wrong.bounces.first == wrong.bounces.last;
    const std::string chance = wrong.test.p < wrong.threshold
                                   ? fmt::format(" (by chance in 1 of {:.0g})", 1.0 / std::max(wrong.test.p, 1e-300))
                                   : ", in other places";
    return fmt::format("{} {} the first to differ: {} {:.4g} ± {:.2g} of our light{}{}.", bounces, is_one ? "is" : "are",
                       is_one ? "it has" : "they have", wrong.test.ratio, 1.96 * wrong.test.ratio_error, chance,
                       is_first ? "" : "; those before agree");
}

std::string what_it_looks_like(const Suspect& best, const Suspect& next) {
    return fmt::format("It looks as if {}{}{}.", best.words, best.left.p < 1e-6 ? ", which explains most but not all of it" : "",
                       next.misfit - best.misfit < clear_lead ? fmt::format("; or {}", next.words) : "");
}

std::string where_it_is(const ShapeShare& most, const Scene& scene) {
    return fmt::format("{:.0f}% of the squared difference is on {}, which has {:.3g} of our light.", 100.0 * most.share,
                       title(scene, most.shape), most.ratio);
}

}  // namespace

std::vector<std::string> sentences_about(const Blame& blame, const Scene& scene) {
    std::vector<std::string> say;
    if (blame.first_wrong) {
        say.push_back(which_bounce(blame.terms[*blame.first_wrong], *blame.first_wrong == 0));
        say.push_back(what_it_looks_like(blame.suspects[0], blame.suspects[1]));
        say.push_back(where_it_is(blame.shapes[0], scene));
    } else {
        say.push_back(no_difference(blame.terms));
    }
    if (blame.told)
        say.push_back(fmt::format("The pictures' means look as if depths were counted as {} does, not as {}.", name_of(*blame.told),
                                  name_of(blame.counting)));
    if (!blame.knows_their_noise)
        say.push_back("Their noise was judged by the pictures themselves; those of a second seed would tell it.");
    return say;
}

}  // namespace neumann
