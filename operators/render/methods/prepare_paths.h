// Prepares a render by paths before its first sample.
#pragma once

#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/methods/render_job.h"

namespace neumann {

// Prepares the method within the render's time; false if there is nothing to do. Throws RunError if that takes too
// long, and Stopped.
bool set_up(const Method& method, const RenderJob& job, SamplingSettings& settings);

struct PreparedPaths {
    Method method;  // the method as it is prepared in the available time
    SamplingSettings settings;
    SamplingGoal goal;
    double setup_seconds;
};
// Reports long preparations before they begin. Throws as above, and InputError.
PreparedPaths prepare_paths(const Method& requested, const RenderJob& job);

}  // namespace neumann
