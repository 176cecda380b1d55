// Decides when an unfinished render is written to disk.
#pragma once

#include "apps/output/files/output_folder.h"
#include "apps/output/files/saved_render.h"
#include "core/base/stopwatch.h"

#include <functional>
#include <optional>
#include <string>

namespace neumann {

constexpr double default_checkpoint = 60.0;

// Whether a state of this size is written if nobody asked for it: at most 2 GiB, and at most half of the free bytes on
// the disk, if these are known.
bool is_written_unasked(double bytes, std::optional<double> free);

class Checkpoints {
public:
    // Writes a state every `seconds` (default_checkpoint if not given). At the end of the render a state stays if it was
    // interrupted, if `seconds` are given, or if it `keeps` its samples anyway, as parts and renders that were added to do;
    // otherwise it would be several times as large as the pictures. Finished fields leave no state. If nobody asked for a state, a
    // large one is not written, which is reported once by `tell`. `resuming`: the command that continues the render, for messages.
    Checkpoints(OutputFolder& folder, RequestOnDisk request, std::string resuming, std::optional<double> seconds, bool keeps,
                std::function<void(const std::string&)> tell)
        : folder_(folder),
          request_(std::move(request)),
          resuming_(std::move(resuming)),
          seconds_(seconds.value_or(default_checkpoint)),
          is_requested_(seconds || keeps),
          keeps_(keeps),
          has_seconds_(seconds.has_value()),
          tell_(std::move(tell)) {}

    // The callbacks for a render that continues `from` a state, or begins. They write the states, and throw RunError
    // with advice if that fails. They refer to this object.
    Saving saving(std::optional<RenderState> from);

private:
    void keep(const RecordedRender& render, const std::optional<MethodChoice>& choice, const RenderedSeries& series, bool is_last);
    void keep_fields(const RecordedRender& render, const std::optional<MethodChoice>& choice, const FieldProgress& progress);
    bool is_wanted(double bytes);
    // Whether a state is due, from the time since the last one.
    bool is_due() const;
    void save(const std::function<void()>& write, const std::string& before);

    OutputFolder& folder_;
    RequestOnDisk request_;
    std::string resuming_;
    double seconds_;
    bool is_requested_, keeps_, has_seconds_, has_reported_ = false, has_saved_ = false;
    std::function<void(const std::string&)> tell_;
    std::uint64_t samples_on_disk_ = 0;
    std::size_t fields_on_disk_ = 0;  // number of replicates
    std::size_t rows_on_disk_ = 0;
    double writing_seconds_ = 0.0;  // for the last state
    Stopwatch since_last_;
};

}  // namespace neumann
