// The results of a study so far.
#pragma once

#include "apps/commands/study_reference.h"
#include "operators/study/method_summary.h"

#include <functional>
#include <memory>

namespace neumann {

// One render: of one method, with one budget, in one repeat. `method` and `budget` are indices into the plan.
struct StudyRun {
    std::size_t method = 0, budget = 0, repeat = 0;
    std::uint64_t seed = 0, samples = 0, patches = 0,
                  directions = 0;  // patches and directions as requested; 0 if the method has none
    double setup_seconds = 0.0, seconds = 0.0, peak_memory = 0.0;
    std::vector<std::uint64_t> rays;     // of each bounce 0 … N
    std::vector<double> mean;            // of each bounce, and of their sum
    std::vector<double> discretisation;  // relative, as the method estimates it, for the same pictures; empty if there is none
    std::string variance;                // a letter for each bounce: f finite, i infinite, ? unknown
    std::vector<std::string> warnings;
};

// All repeats of one method at one budget.
struct StudyPoint {
    std::vector<StudyRun> runs;
    std::vector<ErrorStatistics> errors;  // of each bounce, and of their sum

    std::size_t method() const { return runs.front().method; }
    std::size_t budget() const { return runs.front().budget; }
    RepeatCosts costs() const;
    // Whether the variance is infinite according to more than half of the runs that could tell; for the sum: of any bounce.
    bool infinite_variance(std::size_t picture) const;
};

// Called with what is being done, and with the fraction of all runs that is done.
using StudyStatus = std::function<void(const std::string& what, double fraction)>;

struct StudyData {
    const StudyRequest& request;
    const std::vector<StudyMethod>& methods;
    const Scene& scene;
    const Pilot& pilot;
    int bounces = 0;
    StudyPlan plan;
    StudyReference reference;
    double scene_seconds = 0.0, pilot_seconds = 0.0;
    bool peak_is_of_run = true;      // the peak memory is of each run; otherwise of all runs so far
    std::vector<StudyPoint> points;  // those with at least two repeats
    bool complete = false;

    std::size_t pictures() const { return static_cast<std::size_t>(bounces) + 2; }               // the last is the sum
    std::size_t runs() const { return request.repeats * plan.budgets.size() * methods.size(); }  // in all
    std::vector<const StudyPoint*> points_of(std::size_t method) const;
    std::string picture_name(std::size_t picture) const;
    // The budget in seconds, if a run missed it by more than a tenth; nothing for budgets in samples.
    std::optional<double> missed_budget(const StudyPoint& point) const;
    std::vector<std::string> warnings() const;
};

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
std::vector<StudiedPicture> summarise(const StudyData& data);

struct StudyEnd {
    bool complete;
    std::size_t done, runs;
};
// Runs the study in request.output, and calls `found` with the results, if there are any. Throws InputError and RunError.
StudyEnd run_study(
    StudyRequest request, const Scene& scene, double scene_seconds, const StudyStatus& status,
    const std::function<void(const StudyData&, const std::vector<StudiedPicture>&, const nlohmann::ordered_json&)>& found);

std::string study_csv(const StudyData& data);
nlohmann::ordered_json study_json(const StudyData& data, const std::vector<StudiedPicture>& pictures);
void print_study(const StudyData& data, const std::vector<StudiedPicture>& pictures);
std::string study_page(const nlohmann::ordered_json& study);

// The command line that renders the pictures of a run again.
std::string repeating_command(const StudyData& data, const StudyRun& run);

}  // namespace neumann
