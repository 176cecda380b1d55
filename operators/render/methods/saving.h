// How a render is saved and shown while it is under way, and goes on from there in another process.
#pragma once

#include "operators/render/from_fields/field_progress.h"
#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/methods/method_choice.h"
#include "operators/render/methods/recorded_render.h"

#include <functional>
#include <limits>
#include <optional>

namespace neumann {

struct BounceSeries;

struct RenderState {
    RecordedRender render;
    std::optional<MethodChoice> choice = {};  // how --method auto came to it
    RenderedSeries series;
    std::optional<FieldProgress> fields = {};  // of a method with fields on patches, and no series
};

struct Saving {
    // Of the same scene; it says which method, seed and bounces are rendered. The goal may be another one.
    std::optional<RenderState> from = {};
    // Samples of paths: called after every part, and once more when the last one is done, from the thread that renders. What it
    // throws ends the render.
    std::function<void(const RecordedRender&, const std::optional<MethodChoice>&, const RenderedSeries&, bool is_last)> keep =
        [](const auto&, const auto&, const auto&, bool) {};
    // Fields: as FieldSaving.
    std::function<bool(bool is_stopped)> fields_are_due = [](bool) { return false; };
    std::function<void(const RecordedRender&, const std::optional<MethodChoice>&, const FieldProgress&)> keep_fields =
        [](const auto&...) {};
    std::function<void()> has_all_fields = [] {};
    double longest_part = std::numeric_limits<double>::infinity();  // seconds; but a part has at least one replicate
    // Called with what makes the series so far, which may be used until this returns: after every part, once errors are known, and
    // after every refinement of fields, from the thread that renders. It has neither health nor ways. Empty: not wanted.
    std::function<void(const std::function<BounceSeries()>& so_far)> see = {};
};

}  // namespace neumann
