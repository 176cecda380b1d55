// The results of a study so far.
#pragma once

#include "apps/output/study/study_reference.h"
#include "operators/experiments/study/bounces_together.h"
#include "operators/experiments/study/compared_crops.h"
#include "operators/experiments/study/verdict.h"

#include <functional>
#include <memory>

namespace neumann {

// Called with a description of the present work, and with the finished fraction of all runs.
using StudyStatus = std::function<void(const std::string& what, double fraction)>;

struct StudyData {
    const StudyRequest& request;
    const std::vector<StudyMethod>& methods;
    const Scene& scene;
    const Pilot& pilot;
    Crew* crew = nullptr;  // processes that render with this one
    int bounces = 0;
    StudyPlan plan;
    StudyReference reference;
    double scene_seconds = 0.0, pilot_seconds = 0.0;
    bool peak_is_of_run = true;         // whether the peak memory is of each run; otherwise it is of all runs so far
    std::vector<StudyPoint> points;     // those with at least two repeats
    std::vector<std::string> left_out;  // methods that refuse the scene, and why, if none were named
    std::vector<ComparedCrop> crops;
    bool complete = false;
    std::optional<int> first_bounce = {};  // of the verdict; none: it is on the sum of all

    // Of a run: the bounces, and their sum. A verdict on some bounces is on one picture more, these together.
    std::size_t sum() const { return static_cast<std::size_t>(bounces) + 1; }
    std::size_t pictures_of_run() const { return sum() + 1; }
    std::size_t pictures() const { return pictures_of_run() + (first_bounce ? 1 : 0); }  // the verdict is on the last
    StackedBounces of_verdict() const { return {static_cast<std::size_t>(first_bounce.value_or(0)), sum() - 1}; }
    std::size_t runs() const { return request.repeats * plan.budgets.size() * methods.size(); }  // in all
    std::string picture_name(std::size_t picture) const;                                         // "0" … "sum", "1-4"
    std::string picture_title(std::size_t picture) const;  // "bounce 0" … "the sum of bounces 0 to 4", "bounces 1 to 4 together"
    std::vector<std::string> warnings() const;
    // The least number of any point; smaller than requested if the study was cut off.
    std::size_t fewest_repeats() const;
};

struct StudyEnd {
    bool complete;
    std::size_t done, runs;
};
// Runs the study in request.output, and calls `found` with the results, if there are any. `own`: the estimators that
// the methods name. Throws InputError and RunError.
StudyEnd run_study(
    StudyRequest request, const std::map<std::string, OwnEstimator>& own, Crew* crew, const Scene& scene, double scene_seconds,
    const StudyStatus& status,
    const std::function<void(const StudyData&, const std::vector<StudiedPicture>&, const nlohmann::ordered_json&)>& found);

std::string study_csv(const StudyData& data);
nlohmann::ordered_json study_json(const StudyData& data, const std::vector<StudiedPicture>& pictures);
void print_study(const StudyData& data, const std::vector<StudiedPicture>& pictures);
std::string study_page(const StudyData& data, const nlohmann::ordered_json& study);
// Writes figure-error.svg, figure-error.pdf and verdict.tex, of what the verdict is on.
void write_figures(OutputFolder& folder, const StudyData& data, const std::vector<StudiedPicture>& pictures);
// "In bounce 1 matrix is 160 times as fast as walk (140 to 180)."
std::string verdict_text(const StudyData& data, std::size_t picture, const StudyVerdict& verdict);

// The command line that renders the pictures of a run again.
std::string repeating_command(const StudyData& data, const StudyRun& run);

}  // namespace neumann
