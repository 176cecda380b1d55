// Saves and shows a render while it is under way, and continues it in another process.
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
    std::optional<MethodChoice> choice = {};  // how --method auto chose it
    RenderedSeries series;
    std::optional<FieldProgress> fields = {};  // for a method with fields on patches, which has no series
};

struct Saving {
    // The state to continue from, of the same scene; it determines method, seed and bounces, but not the goal.
    std::optional<RenderState> from = {};
    // For samples of paths: called after every part, and once more when the last one is done, from the thread that
    // renders. Its exceptions end the render.
    std::function<void(const RecordedRender&, const std::optional<MethodChoice>&, const RenderedSeries&, bool is_last)> keep =
        [](const auto&, const auto&, const auto&, bool) {};
    // For fields: as in FieldSaving.
    std::function<bool(bool is_stopped)> fields_are_due = [](bool) { return false; };
    std::function<void(const RecordedRender&, const std::optional<MethodChoice>&, const FieldProgress&)> keep_fields =
        [](const auto&...) {};
    std::function<void()> has_all_fields = [] {};
    double longest_part = std::numeric_limits<double>::infinity();  // seconds; but a part has at least one replicate
    // Called with a function that makes the series so far, valid until `see` returns: after every part, once errors are known, and
    // after every refinement of fields, from the thread that renders. The series has neither health nor ways. Empty: not wanted.
    std::function<void(const std::function<BounceSeries()>& so_far)> see = {};
};

}  // namespace neumann
