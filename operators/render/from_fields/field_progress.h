// What there is of a render from fields on patches while it is under way, from which another process can go on, to the same bits.
#pragma once

#include "operators/fields/matrix/saved_series.h"
#include "operators/render/from_fields/field_pictures.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace neumann {

struct FieldProgress {
    FieldSettings settings;
    double seconds = 0.0;                               // of the whole render or search so far
    double field_seconds = 0.0, picture_seconds = 0.0;  // of these settings, to trace and sum, and to read
    std::vector<SavedSeries> series;                    // of the first replicates

    // Groups of pixels [begin, end) that have been read.
    struct Read {
        std::uint32_t begin, end;
        RaysByBounce rays;
        std::span<const float> values;  // as FieldPictures has them
    };
    std::vector<Read> read;
    std::vector<float> values;  // those to which `read` refers, if it is alone
};

struct FieldSaving {
    // Taken if it has the settings that are to be rendered. A search for settings goes to these, which have to be within its
    // limits, as soon as it may.
    std::optional<FieldProgress> from = {};
    // Whether progress is to be kept now, or, in the end, that of a render that was stopped; as keep(), from any thread, one at a
    // time.
    std::function<bool(bool is_stopped)> is_due;
    std::function<void(FieldProgress&)> keep;
    // When all pictures of what was kept last are there.
    std::function<void()> has_all = [] {};
};

// Whether both make the same pictures.
bool same_pictures(FieldSettings a, const FieldSettings& b);
// Whether a search that ends with `most` may render with these settings.
bool is_within(const FieldSettings& settings, const FieldSettings& most);

}  // namespace neumann
