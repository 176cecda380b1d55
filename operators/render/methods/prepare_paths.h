// What a render by paths is made ready with, before its first sample.
#pragma once

#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/methods/render_job.h"

namespace neumann {

// Makes the method ready in the render's time. Returns false if it had nothing to do; throws RunError if it took too long, and
// Stopped.
bool set_up(const Method& method, const RenderJob& job, SamplingSettings& settings);

struct PreparedPaths {
    Method method;  // as it is made ready in the time that there is
    SamplingSettings settings;
    SamplingGoal goal;
    double setup_seconds;
};
// Tells what takes long before it begins. Throws as above, and InputError.
PreparedPaths prepare_paths(const Method& asked, const RenderJob& job);

}  // namespace neumann
