#include "apps/commands/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <cstdio>

namespace neumann {

namespace {

std::string duration(double seconds) {
    if (seconds < 60.0) return fmt::format("{:.0f} s", seconds);
    if (seconds < 3600.0) return fmt::format("{:.0f} min {:02.0f} s", std::floor(seconds / 60.0), std::fmod(seconds, 60.0));
    return fmt::format("{:.0f} h {:02.0f} min", std::floor(seconds / 3600.0), std::fmod(seconds, 3600.0) / 60.0);
}

}  // namespace

std::string progress_text(const RenderProgress& progress) {
    std::string line = fmt::format("bounces 0..{} and rest   {} samples a pixel   {}", progress.bounces, progress.samples,
                                   duration(progress.seconds));
    if (progress.seconds_left)
        line += fmt::format("   {:.0f}%   {} left", 100.0 * std::min(progress.fraction, 1.0), duration(*progress.seconds_left));
    return line;
}

ProgressLine::ProgressLine(bool quiet) : active_(!quiet && isatty(STDERR_FILENO)) {}

ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::show(const RenderProgress& progress) {
    show([&] { return progress_text(progress); });
}

void ProgressLine::show(const std::function<std::string()>& text) {
    if (!active_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    const auto now = std::chrono::steady_clock::now();
    if (!lock || now - last_ < std::chrono::milliseconds(200)) return;
    last_ = now;
    shown_ = true;
    fmt::print(stderr, "\r\033[K{}", text());
    std::fflush(stderr);
}

void ProgressLine::clear() {
    if (!shown_) return;
    fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
    shown_ = false;
}

}  // namespace neumann
