#include "apps/commands/checkpoints.h"

#include "apps/commands/interrupt.h"
#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace neumann {

namespace {

// At most this part of the time goes into writing states.
constexpr double writing_share = 0.05;
// What is written without being asked for, and of the free space.
constexpr double most_unasked = 0x1p31, most_of_free_space = 0.5;

double bytes_of(const RenderedSeries& series) {
    double bytes = static_cast<double>(series.moments.ranges().of.size() * sizeof(SampleRange));
    for (const SeriesMoments::Node& node : series.moments.nodes()) bytes += static_cast<double>(node.data->size() * sizeof(double));
    return bytes;
}

}  // namespace

bool Checkpoints::is_wanted(const RenderedSeries& series) {
    if (is_asked_) return true;
    const double bytes = bytes_of(series);
    std::error_code unknown;
    const auto space = std::filesystem::space(folder_.path(), unknown);
    if (bytes <= most_unasked && (unknown || bytes <= most_of_free_space * static_cast<double>(space.available))) return true;
    if (!std::exchange(has_told_, true))
        tell_(
            fmt::format("{:.2g} GiB of samples are not kept on the disk while the render is under way; --checkpoint asks for that",
                        bytes / 0x1p30));
    return false;
}

void Checkpoints::keep(const RecordedRender& render, const std::optional<MethodChoice>& choice, const RenderedSeries& series,
                       bool is_last) {
    const bool is_due = since_last_.seconds() >= std::max(seconds_, writing_seconds_ / writing_share);
    const bool is_new = series.samples != samples_on_disk_ || series.convergence.size() != rows_on_disk_;
    const bool wants_end = is_last && (keeps_ || is_due || interrupted()) && is_new;
    if ((!wants_end && (is_last || !is_due)) || !is_wanted(series)) return;
    const Stopwatch clock;
    try {
        save_render(folder_, request_, render, choice, series);
    } catch (const RunError& error) {
        throw RunError(samples_on_disk_ > 0 ? fmt::format("{}\nThe state before it is whole: {} goes on from {} samples a pixel",
                                                          error.what(), resuming_, samples_on_disk_)
                                            : std::string(error.what()));
    }
    keeps_ = true;
    samples_on_disk_ = series.samples;
    rows_on_disk_ = series.convergence.size();
    writing_seconds_ = clock.seconds();
    since_last_ = Stopwatch();
}

}  // namespace neumann
