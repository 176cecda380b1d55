// The runs of a study and their evaluation: for each method and budget the errors of its repeats, and for each picture
// the methods in order of rank.
#pragma once

#include "operators/experiments/study/bounces_together.h"
#include "operators/experiments/study/method_summary.h"
#include "operators/experiments/study/study_plan.h"

#include <functional>

namespace neumann {

// One render: of one method, with one budget, in one repeat. `method` and `budget` are indices into the plan.
struct StudyRun {
    std::size_t method = 0, budget = 0, repeat = 0;
    std::uint64_t seed = 0, samples = 0, patches = 0,
                  directions = 0;  // patches and directions as requested; 0 if the method has none
    double setup_seconds = 0.0, seconds = 0.0, peak_memory = 0.0;
    std::vector<std::uint64_t> rays;  // of each bounce 0 … N
    std::vector<double> mean;         // of each bounce, and of their sum
    // Relative, as the method estimates it, for the same pictures; empty if there is none.
    std::vector<double> discretisation;
    std::string variance;  // a letter for each bounce: f finite, i infinite, ? unknown
    std::vector<std::string> warnings;

    std::uint64_t all_rays() const;
    double mean_of(const StackedBounces& bounces) const;  // over their pictures
};

// Describes a render of `requested`, the method with its effort; its place in the study and its memory are not set.
StudyRun study_run(const BounceSeries& series, const Method& requested);

// The method, budget and repeat of the n-th run. The outer loop is over repeats, so that other load on the machine affects all
// methods and budgets alike, and an interrupted study has some runs of each.
struct StudyPlace {
    std::size_t method, budget, repeat;
};
StudyPlace place_of_run(std::size_t n, const StudyPlan& plan);

struct StudyPoint {
    std::vector<StudyRun> runs;
    std::vector<ErrorStatistics> errors;  // of each bounce, of their sum, and of some together if the reference has these
    StackedBounces together = {};

    std::size_t method() const { return runs.front().method; }
    std::size_t budget() const { return runs.front().budget; }
    RepeatCosts costs() const;
    // The mean over the runs; pictures that are no bounce have all rays, and no discretisation if they are no sum.
    double mean_rays(std::size_t picture) const;
    double largest_memory() const;
    std::optional<double> mean_discretisation(std::size_t picture) const;
    // Whether the variance is infinite by more than half of the runs that can tell; for several bounces: of any.
    bool infinite_variance(std::size_t picture) const;
};

// The points of all methods and budgets with at least two repeats. `picture(n, q)` reads picture q of the n-th run; `reference` has
// as many pictures: the bounces, their sum, and, if it has one more, `bounces` together.
std::vector<StudyPoint> study_points(const std::vector<StudyRun>& runs, const StudyPlan& plan,
                                     const std::vector<Estimate>& reference,
                                     const std::function<Image(std::size_t n, std::size_t q)>& picture,
                                     const StackedBounces& bounces = {});

std::vector<const StudyPoint*> points_of_method(const std::vector<StudyPoint>& points, std::size_t method);

// The budget in seconds, if the runs missed it by more than a tenth; nothing for budgets in samples.
std::optional<double> missed_budget(const StudyPlan& plan, const StudyPoint& point);

// The ranked methods for one picture; methods without a point are left out.
struct StudiedMethod {
    std::size_t method;
    PictureSummary summary;
};
struct StudiedPicture {
    double reference_size = 0.0;         // √⟨r̂²⟩
    double reference_noise = 0.0;        // √⟨v⟩, which is subtracted
    double error = 0.0;                  // the RMSE for which seconds_to_error is computed
    std::vector<StudiedMethod> methods;  // best first
};
// The ranked methods for each picture of the reference; empty if there are no points. `relative_error`: the RMSE for
// which seconds_to_error is computed, relative to the reference; by default one that all methods reach.
std::vector<StudiedPicture> summarise(const std::vector<StudyPoint>& points, const StudyPlan& plan,
                                      const std::vector<Estimate>& reference, std::optional<double> relative_error);

}  // namespace neumann
