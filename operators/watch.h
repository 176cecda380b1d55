// Callbacks of work that takes a while (a render, a study, a matrix, a solver, a search for eigenvalues), the only way to stop it,
// and who helps with it. Each kind of work uses those that make sense for it.
#pragma once

#include "core/base/error.h"
#include "core/image/image.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

class Crew;

struct RenderProgress {
    int bounces = 0;            // 0 … N have pictures
    std::uint64_t samples = 0;  // finished samples per pixel
    double seconds = 0.0;       // so far
    double fraction = 0.0;      // part of the goal that is done, 0 … 1, as far as known
    std::optional<double> seconds_left = {};
};

// The error at one number of samples.
struct Checkpoint {
    std::uint64_t samples = 0, rays = 0;
    double seconds = 0.0;
    std::vector<double> term_error;       // relative standard error of each term 0 … N
    double sum_error = 0.0;               // relative standard error of Σ_{k≤N}
    std::vector<double> true_term_error;  // relative error against a reference, if there is one
    std::optional<double> true_sum_error;
};

struct Watch {
    // Called from any thread; must stay true once it is. The work then ends soon and returns what it has, or throws Stopped.
    std::function<bool()> stop = [] { return false; };
    // Called from time to time, from any thread.
    std::function<void(const RenderProgress&)> progress = [](const RenderProgress&) {};
    // Called with N as soon as it is chosen, before anything is sampled. An exception that it throws ends the render.
    std::function<void(int bounces)> chosen = [](int) {};
    // Called with a message, in words, if something unexpected happens.
    std::function<void(const std::string&)> tell = [](const std::string&) {};
    // Fills in the true errors of a checkpoint, given the terms and their sum so far; empty if there is no reference.
    std::function<void(const std::function<Image(std::size_t)>& term, const Image& sum, Checkpoint&)> judge = {};
    // Called with N and pictures of the terms 0 … N so far, for looking at, each made when it is asked for: first with those that
    // are there within a moment, rough and perhaps smaller, then as they become better; pixels are joined with neighbours that
    // agree (operators/statistics/joined_neighbours.h). From the thread that renders. Empty: not wanted.
    std::function<void(std::size_t bounces, const std::function<Image(std::size_t)>& term)> show = {};
    // Whether to make checkpoints before the last one; they cost time.
    bool checkpoints = true;
    // Processes that sample paths, too; null: this one alone.
    Crew* crew = nullptr;
};

// Thrown by work that was stopped and has no result.
class Stopped : public RunError {
public:
    explicit Stopped(const std::string& what = "interrupted") : RunError(what) {}
};

}  // namespace neumann
