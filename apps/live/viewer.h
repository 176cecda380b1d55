// A viewer of unfinished renders, and a limit on the time that viewing takes.
#pragma once

#include "apps/output/rendering_files.h"

#include <chrono>
#include <utility>

namespace neumann {

class Viewer {
public:
    virtual ~Viewer() = default;
    // Called from the thread that renders, which waits.
    virtual void see(const Rendering& so_far) = 0;
};

// Limits work beside a render to a small part of its time: after each piece nothing is due for `rest` times its duration.
class SmallShare {
public:
    using Clock = std::chrono::steady_clock;
    explicit SmallShare(int rest, std::chrono::duration<double> before_the_first = {})
        : rest_(rest), next_(Clock::now() + std::chrono::duration_cast<Clock::duration>(before_the_first)) {}

    bool is_due() const { return Clock::now() >= next_; }
    template <typename Work>
    void spend(const Work& work) {
        const auto begin = Clock::now();
        work();
        next_ = Clock::now() + rest_ * (Clock::now() - begin);
    }

private:
    int rest_;
    Clock::time_point next_;
};

}  // namespace neumann
