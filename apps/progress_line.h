// One line on a terminal that is written over again while work goes on.
#pragma once

#include "operators/pictures/render.h"

#include <chrono>
#include <mutex>

namespace neumann {

class ProgressLine {
public:
    // Writes to stderr, and only if that is a terminal and `quiet` is not set.
    ProgressLine(int bounces, bool quiet);
    ~ProgressLine();

    // From any thread; most calls do nothing.
    void show(const RenderProgress& progress);
    void clear();

private:
    int bounces_;
    bool active_;
    bool shown_ = false;
    std::mutex mutex_;
    std::chrono::steady_clock::time_point last_{};
};

}  // namespace neumann
