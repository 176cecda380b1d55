#include "apps/output/files/checkpoints.h"

#include "core/base/error.h"
#include "core/base/interrupt.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace neumann {

namespace {

// At most this part of the time goes into writing states.
constexpr double writing_share = 0.05;

double bytes_of(const RenderedSeries& series) {
    double bytes = static_cast<double>(series.moments.ranges().of.size() * sizeof(SampleRange));
    for (const SeriesMoments::Node& node : series.moments.nodes()) bytes += static_cast<double>(node.data->size() * sizeof(double));
    return bytes;
}

double bytes_of(const FieldProgress& progress) {
    double bytes = 0.0;
    for (const SavedSeries& series : progress.series) bytes += static_cast<double>(series.size() * sizeof(float));
    for (const FieldProgress::Read& read : progress.read) bytes += static_cast<double>(read.values.size_bytes());
    return bytes;
}

}  // namespace

bool is_written_unasked(double bytes, std::optional<double> free) {
    constexpr double most = 0x1p31, most_of_free = 0.5;
    return bytes <= most && (!free || bytes <= most_of_free * *free);
}

bool Checkpoints::is_wanted(double bytes) {
    if (is_requested_) return true;
    std::error_code unknown;
    const auto space = std::filesystem::space(folder_.path(), unknown);
    const auto free = unknown ? std::nullopt : std::optional(static_cast<double>(space.available));
    if (is_written_unasked(bytes, free)) return true;
    if (!std::exchange(has_reported_, true))
        tell_(fmt::format(
            "{:.2g} GiB of what is there are not kept on the disk while the render is under way; --checkpoint asks for that",
            bytes / 0x1p30));
    return false;
}

Saving Checkpoints::saving(std::optional<RenderState> from) {
    Saving saving;
    has_saved_ = from.has_value();
    saving.from = std::move(from);
    saving.longest_part = 0.5 * seconds_;
    saving.keep = [this](const auto&... so_far) { keep(so_far...); };
    // Results that took long are also kept if the time is up.
    saving.fields_are_due = [this](bool is_stopped) { return is_stopped ? interrupted() || has_saved_ : is_due(); };
    saving.keep_fields = [this](const auto&... so_far) { keep_fields(so_far...); };
    saving.has_all_fields = [this] { folder_.has_all_of_saved(); };
    return saving;
}

bool Checkpoints::is_due() const { return since_last_.seconds() >= std::max(seconds_, writing_seconds_ / writing_share); }

void Checkpoints::save(const std::function<void()>& write, const std::string& before) {
    const Stopwatch clock;
    try {
        write();
    } catch (const RunError& error) {
        if (!has_saved_) throw;
        throw RunError(saved_render_in(folder_.path().string())
                           ? fmt::format("{}\nThe state before it is whole: {} goes on from {}", error.what(), resuming_, before)
                           : fmt::format("{}\nThe state before it, of {}, is gone as well", error.what(), before));
    }
    has_saved_ = true;
    writing_seconds_ = clock.seconds();
    since_last_ = Stopwatch();
}

void Checkpoints::keep(const RecordedRender& render, const std::optional<MethodChoice>& choice, const RenderedSeries& series,
                       bool is_last) {
    const bool due = is_due(), is_new = series.samples != samples_on_disk_ || series.convergence.size() != rows_on_disk_;
    const bool stays = keeps_ || interrupted() || (has_seconds_ && (has_saved_ || due));
    if (is_last && !stays) folder_.has_all_of_saved();
    if (!(is_last ? stays && is_new : due) || !is_wanted(bytes_of(series))) return;
    save([&] { save_render(folder_, request_, render, choice, series); }, fmt::format("{} samples a pixel", samples_on_disk_));
    samples_on_disk_ = series.samples;
    rows_on_disk_ = series.convergence.size();
}

void Checkpoints::keep_fields(const RecordedRender& render, const std::optional<MethodChoice>& choice,
                              const FieldProgress& progress) {
    if (progress.series.empty()) return;
    if (!is_wanted(bytes_of(progress))) {
        since_last_ = Stopwatch();
        return;
    }
    save([&] { save_fields(folder_, request_, render, choice, progress); },
         fmt::format("{} of {} replicates", fields_on_disk_, progress.settings.replicates));
    fields_on_disk_ = progress.series.size();
}

}  // namespace neumann
