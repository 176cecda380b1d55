#include "operators/experiments/blame/suspects.h"

#include "operators/experiments/blame/explained.h"
#include "operators/experiments/blame/joined_pixels.h"
#include "operators/experiments/blame/likelihood.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace neumann {

namespace {

int factor_of(const std::vector<ComparedTerm>& terms) {
    return joining_factor(terms.front().theirs.mean.width, terms.front().theirs.mean.height);
}

std::vector<ComparedTerm> of_fewer_pixels(const std::vector<ComparedTerm>& terms) {
    std::vector<ComparedTerm> result;
    for (const ComparedTerm& t : terms) result.push_back(joined(t, factor_of(terms)));
    return result;
}

double of_none(const std::vector<ComparedTerm>& terms) {
    double sum = 0.0;
    for (const ComparedTerm& t : terms) sum += misfit(t.theirs, t.ours);
    return sum;
}

class Suspects {
public:
    explicit Suspects(const std::vector<ComparedTerm>& terms)
        : terms_(terms), explained_(terms.front().theirs, terms.front().ours) {}

    void add(const std::string& name, const std::string& words, const std::vector<PictureNoise>& wrong, int parameters,
             bool is_fitted, bool is_smoothed = false, bool is_a_cause = true, double p_of_before = 1.0) {
        Suspect suspect{name, words, 0.0, is_fitted, is_a_cause, explained_.by(wrong[0])};
        suspect.p_of_all_that_is_left = p_of_before;
        suspect.misfit = parameters * std::log(static_cast<double>(terms_.front().ours.mean.pixels.size() * 3 * terms_.size()));
        for (std::size_t i = 0; i < terms_.size(); ++i) {
            suspect.misfit += misfit(terms_[i].theirs, wrong[i], is_smoothed ? terms_[i].ours.variance : wrong[i].variance);
            const double p = test_difference(terms_[i].theirs, wrong[i]).p;
            if (i == 0) suspect.p_of_what_is_left = p;
            suspect.p_of_all_that_is_left = std::min(suspect.p_of_all_that_is_left, p * static_cast<double>(terms_.size()));
        }
        all_.push_back(std::move(suspect));
    }

    std::vector<Suspect> likeliest_first() {
        std::stable_sort(all_.begin(), all_.end(), [](const Suspect& a, const Suspect& b) { return a.misfit < b.misfit; });
        constexpr double unexplained = 1e-3, most_of_it = 0.9;
        const auto leaves_nothing = [](const Suspect& s) { return !s.is_fitted && s.p_of_all_that_is_left > unexplained; };
        const double right = of_none(terms_);
        const auto best = std::ranges::find_if(all_, leaves_nothing);
        const double most = best == all_.end() ? 0.0 : most_of_it * (right - best->misfit);
        std::stable_partition(all_.begin(), all_.end(), [&](const Suspect& s) {
            return leaves_nothing(s) && (s.explains() || (right - s.misfit > most && right > s.misfit));
        });
        std::map<std::string, double> most_explained;
        for (const Suspect& s : all_) most_explained[s.name] = std::max(most_explained[s.name], s.explained);
        std::set<std::string> seen;
        std::erase_if(all_, [&](const Suspect& s) { return !seen.insert(s.name).second; });
        for (Suspect& s : all_) s.explained = most_explained[s.name];
        return std::move(all_);
    }

private:
    const std::vector<ComparedTerm>& terms_;
    const Explained explained_;
    std::vector<Suspect> all_;
};

}  // namespace

double misfit_of_none(const std::vector<ComparedTerm>& terms) { return of_none(of_fewer_pixels(terms)); }

std::vector<Suspect> find_suspects(ExpectedPictures& expected, const ComparedTerm* before, const std::vector<ComparedTerm>& terms,
                                   bool are_sums, const std::vector<std::uint32_t>& shapes) {
    const int factor = factor_of(terms), width = terms.front().theirs.mean.width;
    const std::vector<ComparedTerm> of_fewer = of_fewer_pixels(terms);
    Suspects suspects(of_fewer);
    const auto add = [&](const WrongPictures& w) {
        // A shift or blur must already show in bounce 0.
        suspects.add(w.name, w.words, w.terms, w.parameters, w.parameters > 0, w.is_smoothed,
                     w.is_a_cause && (!w.is_smoothed || terms.front().bounces.first == 0));
    };
    for (const WrongPictures& w : moved_pictures(terms, are_sums, factor)) add(w);
    for (const WrongPictures& w : scaled_pictures(of_fewer, at_middles(shapes, width, factor))) add(w);
    std::vector<BounceRange> ranges, with_before;
    PictureNoise theirs_before;
    if (before) {
        with_before.push_back(before->bounces);
        theirs_before = joined(before->theirs, factor);
    }
    for (const ComparedTerm& t : terms) ranges.push_back(t.bounces);
    with_before.insert(with_before.end(), ranges.begin(), ranges.end());
    const std::ptrdiff_t first = before ? 1 : 0;
    for (const WrongTerms& w :
         *expected.wrong({.ranges = with_before, .begins = static_cast<std::size_t>(first), .factor = factor})) {
        if (w.mistake() == Mistake::none || (w.mistake() == Mistake::no_samples_at_the_end && !are_sums)) continue;
        const std::vector<PictureNoise> of_terms(w.terms.begin() + first, w.terms.end());
        const auto add_times = [&](double times, int parameters) {
            const double p = before ? test_difference(theirs_before, scaled(w.terms[0], times)).p : 1.0;
            std::vector<PictureNoise> rescaled;
            for (const PictureNoise& of_term : of_terms) rescaled.push_back(scaled(of_term, times));
            suspects.add(w.kind->name, w.kind->words, rescaled, parameters, false, false, true, p);
        };
        add_times(1.0, 0);
        // Without 1/d² light has no unit, and may have any scale.
        if (w.mistake() == Mistake::no_inverse_square || w.mistake() == Mistake::inverse_distance)
            add_times(fitted_factor(of_fewer[0].theirs, of_terms[0]), 1);
    }
    for (const WrongPictures& w : *expected.without_techniques(ranges, factor)) suspects.add(w.name, w.words, w.terms, 0, false);
    return suspects.likeliest_first();
}

}  // namespace neumann
