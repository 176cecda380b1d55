// What a render tells whoever looks on while it works, and the one way to stop it.
#pragma once

#include "core/image/image.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct RenderProgress {
    int bounces;            // 0 … N have pictures
    std::uint64_t samples;  // a pixel, finished
    double seconds;         // so far
    double fraction;        // of the goal, as far as known; 0 … 1
    std::optional<double> seconds_left;
};

// The error at one number of samples.
struct Checkpoint {
    std::uint64_t samples = 0, rays = 0;
    double seconds = 0.0;
    std::vector<double> term_error;       // relative standard error of each term 0 … N
    double sum_error = 0.0;               // and of Σ_{k≤N}
    std::vector<double> true_term_error;  // relative error against a reference, if there is one
    std::optional<double> true_sum_error;
};

struct Watch {
    // Asked from any thread; once true it stays so. The render ends soon, with what it has.
    std::function<bool()> stop = [] { return false; };
    // From time to time, from any thread.
    std::function<void(const RenderProgress&)> progress = [](const RenderProgress&) {};
    // The last bounce, as soon as it is known and before anything is sampled. What it throws ends the render.
    std::function<void(int bounces)> chosen = [](int) {};
    // What happens, in words, where that is a surprise.
    std::function<void(const std::string&)> tell = [](const std::string&) {};
    // Fills in the true errors of a checkpoint, given the terms and their sum so far. Without it there is nothing to judge by.
    std::function<void(const std::function<Image(std::size_t)>& term, const Image& sum, Checkpoint&)> judge = {};
    // Whether there are checkpoints before the last one: they take time of their own.
    bool checkpoints = true;
};

}  // namespace neumann
