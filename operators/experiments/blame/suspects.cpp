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
             bool is_fitted, bool is_smoothed = false, bool is_a_cause = true) {
        Suspect suspect{name, words, 0.0, is_fitted, is_a_cause, explained_.by(wrong[0])};
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
        const double best = all_.front().misfit, right = misfit_of_none(terms_);
        std::stable_partition(all_.begin(), all_.end(), [&](const Suspect& s) {
            return !s.is_fitted && s.p_of_all_that_is_left > unexplained &&
                   (right - s.misfit > most_of_it * (right - best) || s.explains());
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

std::vector<Suspect> find_suspects(ExpectedPictures& expected, const std::vector<ComparedTerm>& terms, bool are_sums,
                                   const std::vector<std::uint32_t>& shapes) {
    Suspects suspects(terms);
    for (const WrongPictures& w : wrong_pictures(terms, are_sums, shapes))
        // A shift or blur must already show in bounce 0.
        suspects.add(w.name, w.words, w.terms, w.parameters, w.parameters > 0, w.is_smoothed,
                     w.is_a_cause && (!w.is_smoothed || terms.front().bounces.first == 0));
    std::vector<BounceRange> ranges;
    for (const ComparedTerm& t : terms) ranges.push_back(t.bounces);
    for (const WrongTerms& w : *expected.wrong(ranges)) {
        if (w.mistake() == Mistake::none || (w.mistake() == Mistake::no_samples_at_the_end && !are_sums)) continue;
        suspects.add(w.kind->name, w.kind->words, w.terms, 0, false);
        if (w.mistake() != Mistake::no_inverse_square && w.mistake() != Mistake::inverse_distance) continue;
        // Without 1/d² light has no unit, and may have any scale.
        const double factor = fitted_factor(terms[0].theirs, w.terms[0]);
        std::vector<PictureNoise> rescaled;
        for (const PictureNoise& p : w.terms) rescaled.push_back(scaled(p, factor));
        suspects.add(w.kind->name, w.kind->words, rescaled, 1, false);
    }
    for (const WrongPictures& w : *expected.without_techniques(ranges)) suspects.add(w.name, w.words, w.terms, 0, false);
    return suspects.likeliest_first();
}

}  // namespace neumann
