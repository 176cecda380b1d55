#include "operators/experiments/blame/suspects.h"

#include "operators/experiments/blame/explained.h"
#include "operators/experiments/blame/likelihood.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace neumann {

namespace {

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
        const double right = misfit_of_none(terms_);
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

double misfit_of_none(const std::vector<ComparedTerm>& terms) {
    double sum = 0.0;
    for (const ComparedTerm& t : terms) sum += misfit(t.theirs, t.ours);
    return sum;
}

std::vector<Suspect> find_suspects(ExpectedPictures& expected, const ComparedTerm* before, const std::vector<ComparedTerm>& terms,
                                   bool are_sums, const std::vector<std::uint32_t>& shapes) {
    Suspects suspects(terms);
    for (const WrongPictures& w : wrong_pictures(terms, are_sums, shapes))
        // A shift or blur must already show in bounce 0.
        suspects.add(w.name, w.words, w.terms, w.parameters, w.parameters > 0, w.is_smoothed,
                     w.is_a_cause && (!w.is_smoothed || terms.front().bounces.first == 0));
    std::vector<BounceRange> ranges, with_before;
    if (before) with_before.push_back(before->bounces);
    for (const ComparedTerm& t : terms) ranges.push_back(t.bounces);
    with_before.insert(with_before.end(), ranges.begin(), ranges.end());
    const std::ptrdiff_t first = before ? 1 : 0;
    for (const WrongTerms& w : *expected.wrong(with_before, static_cast<std::size_t>(first))) {
        if (w.mistake() == Mistake::none || (w.mistake() == Mistake::no_samples_at_the_end && !are_sums)) continue;
        std::vector<PictureNoise> of_terms(w.terms.begin() + first, w.terms.end());
        const auto add = [&](double factor, int parameters) {
            const double p = before ? test_difference(before->theirs, scaled(w.terms[0], factor)).p : 1.0;
            for (PictureNoise& picture : of_terms) picture = scaled(picture, factor);
            suspects.add(w.kind->name, w.kind->words, of_terms, parameters, false, false, true, p);
        };
        const double factor = fitted_factor(terms[0].theirs, of_terms[0]);
        add(1.0, 0);
        // Without 1/d² light has no unit, and may have any scale.
        if (w.mistake() == Mistake::no_inverse_square || w.mistake() == Mistake::inverse_distance) add(factor, 1);
    }
    for (const WrongPictures& w : *expected.without_techniques(ranges)) suspects.add(w.name, w.words, w.terms, 0, false);
    return suspects.likeliest_first();
}

}  // namespace neumann
