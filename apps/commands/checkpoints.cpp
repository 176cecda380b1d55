#include "apps/commands/checkpoints.h"

#include "apps/commands/interrupt.h"
#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann {

namespace {

// At most this part of the time goes into writing states.
constexpr double writing_share = 0.05;

}  // namespace

void Checkpoints::keep(const RecordedRender& render, const std::optional<MethodChoice>& choice, const RenderedSeries& series,
                       bool is_last) {
    const bool is_due = since_last_.seconds() >= std::max(seconds_, writing_seconds_ / writing_share);
    const bool is_new = series.samples != samples_on_disk_ || series.convergence.size() != rows_on_disk_;
    const bool wants_end = is_last && (keeps_ || is_due || interrupted()) && is_new;
    if (!wants_end && (is_last || !is_due)) return;
    const Stopwatch clock;
    try {
        save_render(folder_, request_, render, choice, series);
    } catch (const RunError& error) {
        throw RunError(samples_on_disk_ > 0
                           ? fmt::format("{}\nThe state before it is whole: neumann render --resume {} goes on from {} "
                                         "samples a pixel",
                                         error.what(), folder_.path().string(), samples_on_disk_)
                           : std::string(error.what()));
    }
    keeps_ = true;
    samples_on_disk_ = series.samples;
    rows_on_disk_ = series.convergence.size();
    writing_seconds_ = clock.seconds();
    since_last_ = Stopwatch();
}

}  // namespace neumann
