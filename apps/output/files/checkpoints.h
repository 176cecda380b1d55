// When a render under way is written to disk.
#pragma once

#include "apps/output/files/output_folder.h"
#include "apps/output/files/saved_render.h"
#include "core/base/stopwatch.h"

#include <functional>
#include <optional>
#include <string>

namespace neumann {

constexpr double default_checkpoint = 60.0;

// Whether so large a state is written without being asked for, where so many bytes are free on the disk, if that is known: at most
// 2 GiB, and at most half of what is free.
bool is_written_unasked(double bytes, std::optional<double> free);

class Checkpoints {
public:
    // A state every so many seconds (default_checkpoint, if they are not given). In the end one stays where the render was
    // interrupted, where `seconds` are given, or where it `keeps` its samples anyway: those of a part, and those that were added
    // to; elsewhere it would be several times as large as the pictures. Fields that are finished have none in the end. If nothing
    // asks for a state, a large one is not written, which `tell` tells once. `resuming`: the command that goes on, for messages.
    Checkpoints(OutputFolder& folder, RequestOnDisk request, std::string resuming, std::optional<double> seconds, bool keeps,
                std::function<void(const std::string&)> tell)
        : folder_(folder),
          request_(std::move(request)),
          resuming_(std::move(resuming)),
          seconds_(seconds.value_or(default_checkpoint)),
          is_asked_(seconds || keeps),
          keeps_(keeps),
          has_seconds_(seconds.has_value()),
          tell_(std::move(tell)) {}

    // For a render that goes on from there, or begins. What it keeps is written here, and RunError, thrown if that fails, tells
    // what to do. Refers to this object.
    Saving saving(std::optional<RenderState> from);

private:
    void keep(const RecordedRender& render, const std::optional<MethodChoice>& choice, const RenderedSeries& series, bool is_last);
    void keep_fields(const RecordedRender& render, const std::optional<MethodChoice>& choice, const FieldProgress& progress);
    bool is_wanted(double bytes);
    // Whether a state is due, from the time since the last.
    bool is_due() const;
    void save(const std::function<void()>& write, const std::string& before);

    OutputFolder& folder_;
    RequestOnDisk request_;
    std::string resuming_;
    double seconds_;
    bool is_asked_, keeps_, has_seconds_, has_told_ = false, has_saved_ = false;
    std::function<void(const std::string&)> tell_;
    std::uint64_t samples_on_disk_ = 0;
    std::size_t fields_on_disk_ = 0;  // replicates
    std::size_t rows_on_disk_ = 0;
    double writing_seconds_ = 0.0;  // of the last state
    Stopwatch since_last_;
};

}  // namespace neumann
