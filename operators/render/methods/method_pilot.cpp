#include "operators/render/methods/method_pilot.h"

#include "core/base/error.h"
#include "operators/render/from_paths/corrected_sampler.h"
#include "operators/render/methods/render_job.h"

#include <algorithm>

namespace neumann {

namespace {

using Term = MethodPilot::Term;

// A difference shows more than the stated errors if its square is this many times as large.
constexpr double clearly_more = 2.0;

double square(const Image& image) {
    double sum = 0.0;
    for (const Rgb& x : image.pixels) sum += glm::dot(x, x);
    return sum;
}

MethodPilot pilot_of(const Candidate& candidate, const BounceSeries& series) {
    MethodPilot pilot{candidate};
    pilot.cast = static_cast<double>(series.convergence.back().rays);
    pilot.rays = pilot.cast;
    if (series.shared_rays > 0)
        pilot.rays = (pilot.cast - static_cast<double>(series.shared_rays)) * (1.0 + CorrectedSampler::share_of_points);
    for (int i = 1; i <= series.bounces(); ++i) {
        const auto bounce = static_cast<std::size_t>(i);
        PixelEstimate term = series.term(bounce);
        const MeanWithError& mean = series.report.bounces[bounce].mean;
        double variance = square(term.standard_error);
        // If replicates agree by chance, their spread shows less than the errors that goals look at.
        if (!has_fields(candidate.method)) {
            const double relative = series.convergence.back().term_error[bounce];
            variance = std::max(variance, relative * relative * square(term.mean));
        }
        pilot.terms.push_back({std::move(term.mean), variance, square(term.discretisation), mean.mean - 2.0 * mean.standard_error});
    }
    pilot.samples = static_cast<double>(series.samples * pilot.terms.front().picture.pixels.size());
    return pilot;
}

const Term* surest(const std::vector<MethodPilot>& known, std::size_t i) {
    const Term* best = &known.front().terms[i];
    for (const MethodPilot& pilot : known)
        if (pilot.terms[i].least_light > best->least_light) best = &pilot.terms[i];
    return best->least_light > 0.0 && best->light() > 0.0 ? best : nullptr;
}
// Σ|a − b|², which includes the variances of both.
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
double relative_error(const MethodPilot& pilot, const std::vector<MethodPilot>& known, const F& error_of) {
    double sum = 0.0;
    for (std::size_t i = 0; i < pilot.terms.size(); ++i)
        if (const Term* best = surest(known, i)) sum += error_of(pilot.terms[i], *best) / best->light();
    return sum;
}

}  // namespace

double MethodPilot::Term::light() const { return square(picture) - variance; }

std::vector<MethodPilot> make_pilots(const std::vector<Candidate>& methods, const Scene& small, const Goal& goal,
                                     Prepared& prepared, const Watch& watch, bool may_refuse) {
    std::vector<MethodPilot> pilots;
    for (const Candidate& candidate : methods) {
        if (watch.stop()) break;
        try {
            const BounceSeries series = render(small, candidate.method, goal, {.stop = watch.stop}, prepared);
            if (series.outcome != Outcome::interrupted) pilots.push_back(pilot_of(candidate, series));
        } catch (const InputError&) {
            // Some methods cannot render all scenes: one without surfaces has no patches.
            if (pilots.empty() && !may_refuse) throw;
        } catch (const RunError&) {
            if (!watch.stop()) throw;
        }
    }
    return pilots;
}

double rays_of(const std::vector<MethodPilot>& pilots) {
    double rays = 0.0;
    for (const MethodPilot& pilot : pilots) rays += pilot.cast;
    return rays;
}

// A method that has not met the rare paths of a bounce sees neither their light nor their variance; so it is also
// compared with the method among `known` that is sure of most light.
double unbiased_error(const MethodPilot& pilot, const std::vector<MethodPilot>& known) {
    return relative_error(pilot, known, [](const Term& term, const Term& best) {
        return std::max(term.variance, square_of_difference(term, best) - best.variance);
    });
}
// The bias counts as it is stated, or as the pictures of `known` show it, if that is clearly more.
double error_with_bias(const MethodPilot& pilot, const std::vector<MethodPilot>& known) {
    return relative_error(pilot, known, [](const Term& term, const Term& best) {
        const double stated = term.variance + term.squared_bias, shown = square_of_difference(term, best);
        return shown > clearly_more * (stated + best.variance) ? shown - best.variance : stated;
    });
}

}  // namespace neumann
