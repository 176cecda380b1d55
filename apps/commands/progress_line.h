// A progress line on a terminal, overwritten as work goes on.
#pragma once

#include "operators/watch.h"

#include <chrono>
#include <functional>
#include <mutex>
#include <string>

namespace neumann {

// "bounces 0..8 and rest   64 samples a pixel   3 s   50%   3 s left"
std::string progress_text(const RenderProgress& progress);

class ProgressLine {
public:
    // Writes to stderr, and only if that is a terminal and `quiet` is not set.
    explicit ProgressLine(bool quiet);
    ~ProgressLine();

    // May be called from any thread; most calls do nothing.
    void show(const RenderProgress& progress);
    void show(const std::function<std::string()>& text);
    void clear();

private:
    bool active_;
    bool shown_ = false;
    std::mutex mutex_;
    std::chrono::steady_clock::time_point last_{};
};

}  // namespace neumann
