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

double bytes_of(const FieldProgress& progress) {
    double bytes = 0.0;
    for (const SavedSeries& series : progress.series) bytes += static_cast<double>(series.fields.size() * sizeof(float));
    for (const FieldProgress::Read& read : progress.read) bytes += static_cast<double>(read.values.size_bytes());
    return bytes;
}

}  // namespace

bool Checkpoints::is_wanted(double bytes) {
    if (is_asked_) return true;
    std::error_code unknown;
    const auto space = std::filesystem::space(folder_.path(), unknown);
    if (bytes <= most_unasked && (unknown || bytes <= most_of_free_space * static_cast<double>(space.available))) return true;
    if (!std::exchange(has_told_, true))
        tell_(fmt::format(
            "{:.2g} GiB of what is there are not kept on the disk while the render is under way; --checkpoint asks for that",
            bytes / 0x1p30));
    return false;
}

Saving Checkpoints::saving(std::optional<RenderState> from) {
    Saving saving;
    saving.from = std::move(from);
    saving.longest_part = 0.5 * seconds_;
    saving.keep = [this](const auto&... so_far) { keep(so_far...); };
    saving.fields_are_due = [this](bool is_stopped) { return is_stopped ? interrupted() : is_due(); };
    saving.keep_fields = [this](const auto&... so_far) { keep_fields(so_far...); };
    return saving;
}

bool Checkpoints::is_due() const { return since_last_.seconds() >= std::max(seconds_, writing_seconds_ / writing_share); }

void Checkpoints::save(const std::function<void()>& write, const std::string& before) {
    const Stopwatch clock;
    try {
        write();
    } catch (const RunError& error) {
        throw RunError(has_saved_
                           ? fmt::format("{}\nThe state before it is whole: {} goes on from {}", error.what(), resuming_, before)
                           : std::string(error.what()));
    }
    has_saved_ = keeps_ = true;
    writing_seconds_ = clock.seconds();
    since_last_ = Stopwatch();
}

void Checkpoints::keep(const RecordedRender& render, const std::optional<MethodChoice>& choice, const RenderedSeries& series,
                       bool is_last) {
    const bool due = is_due(), is_new = series.samples != samples_on_disk_ || series.convergence.size() != rows_on_disk_;
    const bool wants_end = is_last && (keeps_ || due || interrupted()) && is_new;
    if ((!wants_end && (is_last || !due)) || !is_wanted(bytes_of(series))) return;
    save([&] { save_render(folder_, request_, render, choice, series); }, fmt::format("{} samples a pixel", samples_on_disk_));
    samples_on_disk_ = series.samples;
    rows_on_disk_ = series.convergence.size();
}

void Checkpoints::keep_fields(const RecordedRender& render, const std::optional<MethodChoice>& choice,
                              const FieldProgress& progress) {
    if (progress.series.empty() || !is_wanted(bytes_of(progress))) return;
    save([&] { save_fields(folder_, request_, render, choice, progress); }, "there");
}

}  // namespace neumann
