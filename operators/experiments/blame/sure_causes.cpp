#include "operators/experiments/blame/sure_causes.h"

#include "operators/experiments/blame/blame.h"
#include "operators/experiments/blame/picture_mistakes.h"
#include "operators/experiments/blame/sure_pixels.h"

#include <algorithm>

namespace neumann {

namespace {

// The part of the squared difference that a mistake may leave, in pixels that chance hardly changes, and in all lamps that the
// camera sees. The second is larger because a shift is known only roughly: if it is half a pixel, a third is left. If all pixels
// share the same four samples, these lie off the middle, in 1 of 20 pictures so far that a shift leaves as little.
constexpr double most_left_of_sure = 0.1, most_left_of_signs = 0.35;

// Those that change bounce 0.
bool is_of_emission(Mistake mistake) { return mistake == Mistake::no_emission || mistake == Mistake::lamps_shine_back; }

bool is_of_sure_light(Mistake mistake) {
    return mistake == Mistake::no_emission || mistake == Mistake::no_light_after_mirror || mistake == Mistake::no_mirrors;
}

bool is_sure(Mistake mistake) { return mistake == Mistake::none || is_of_emission(mistake) || is_of_sure_light(mistake); }

}  // namespace

std::vector<SureCause> find_sure_causes(ExpectedPictures& expected, const std::vector<ComparedTerm>& compared, bool are_sums) {
    std::vector<SureCause> causes(compared.size());
    std::vector<BounceRange> direct;
    for (const ComparedTerm& c : compared)
        if (c.bounces.last <= 1) direct.push_back(c.bounces);
    if (direct.empty()) return causes;
    const auto made = expected.wrong({.ranges = direct, .is_wanted = is_sure});
    const double samples = expected.paths_a_pixel(1);
    const auto none = std::ranges::find(*made, Mistake::none, &WrongTerms::mistake);
    const double theirs = direct.front() == BounceRange{0, 0}
                              ? fewest_samples(compared.front().theirs, compared.front().ours, {none->terms[0], samples})
                              : 1.0;
    for (std::size_t i = 0; i < direct.size(); ++i) {
        const ComparedTerm& c = compared[i];
        ComparedTerm right = c;
        right.ours = none->terms[i];
        right.our_sum = right.ours.mean;
        std::vector<WrongPictures> wrong;
        if (c.bounces.first == 0) wrong = moved_pictures({right}, are_sums);
        if (c.bounces.last == 0) wrong.push_back({"factor", "a factor", {scaled(right.ours, fitted_factor(c.theirs, c.ours))}});
        for (const WrongTerms& w : *made)
            if (c.bounces.last == 0 ? is_of_emission(w.mistake()) : is_of_sure_light(w.mistake()))
                wrong.push_back({w.kind->name, w.kind->words, {w.terms[i]}});
        const double threshold = false_alarms / static_cast<double>(2 * compared.size() * wrong.size());
        const auto consider = [&](const WrongPictures& w, const SurePixels& found, double most_left) {
            if (found.p < threshold && found.left < std::min(most_left, causes[i].left)) causes[i] = {w.words, found.left};
        };
        const SureLight light{right.ours, samples};
        for (const WrongPictures& w : wrong) {
            consider(w, test_sure_pixels(c.theirs, c.ours, light, w.terms[0], theirs), most_left_of_sure);
            if (c.bounces.last == 0) consider(w, test_signs(c.theirs, c.ours, light, w.terms[0]), most_left_of_signs);
        }
    }
    return causes;
}

}  // namespace neumann
