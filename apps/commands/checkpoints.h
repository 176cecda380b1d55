// When a render under way is written to disk.
#pragma once

#include "apps/files/output_folder.h"
#include "apps/files/saved_render.h"
#include "core/base/stopwatch.h"

namespace neumann {

class Checkpoints {
public:
    // A state every so many seconds, and one in the end if the render took longer or was interrupted, or if it `keeps` its samples
    // anyway: those of a part, and those that were added to.
    Checkpoints(OutputFolder& folder, RequestOnDisk request, double seconds, bool keeps)
        : folder_(folder), request_(std::move(request)), seconds_(seconds), keeps_(keeps) {}

    // As Saving::keep. Throws RunError, which tells what to do, if the state cannot be written.
    void keep(const RecordedRender& render, const std::optional<MethodChoice>& choice, const RenderedSeries& series, bool is_last);

private:
    OutputFolder& folder_;
    RequestOnDisk request_;
    double seconds_;
    bool keeps_;
    std::uint64_t samples_on_disk_ = 0;
    std::size_t rows_on_disk_ = 0;
    double writing_seconds_ = 0.0;  // of the last state
    Stopwatch since_last_;
};

}  // namespace neumann
