// The request of `neumann study`.
#pragma once

#include "apps/requests/option.h"
#include "apps/requests/scene_file.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

// Bounces 0 to `last` are rendered; the verdict is on `first` to `last` if there is a first, else on the sum of all.
struct StudiedBounces {
    std::optional<int> first = {};
    int last = 0;
};

struct StudyRequest {
    SceneFile scene;
    std::string output;  // a folder; empty: out/NAME-study
    // As read_method() reads them, or names of estimators; empty: all that can render the scene.
    std::vector<std::string> methods;
    std::string reference;  // a method that renders it, a folder of an earlier render, or values:…; empty: chosen
    std::optional<std::uint64_t> reference_samples;
    std::vector<double> budgets;         // seconds per run; empty: chosen
    std::vector<std::uint64_t> samples;  // budgets in samples per pixel, in place of seconds
    std::size_t repeats = 16;
    std::optional<double> interval;  // relative half width of the 95% interval of the sum's RMSE, for which repeats are chosen
    std::vector<std::string> crops;  // X,Y,WIDTH,HEIGHT
    std::optional<StudiedBounces> bounces;
    std::optional<double> error;  // relative RMSE, for the time to a given error
    std::uint64_t seed = 0;
    int threads = 0;                   // 0: all
    std::optional<double> checkpoint;  // seconds between two states of a run on disk
    bool resume = false, quiet = false, json = false;
    std::string command_line;  // as typed, for study.json
};

const Options<StudyRequest>& study_options();

}  // namespace neumann
