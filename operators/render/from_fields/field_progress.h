// The state of an unfinished render from fields on patches. Another process can go on from it, to the same bits.
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
    double seconds = 0.0;  // of the whole render or search so far
    // With these settings: for tracing and summing, and for reading the pictures.
    double field_seconds = 0.0, picture_seconds = 0.0;
    std::vector<SavedSeries> series;  // the first replicates

    // Groups of pixels [begin, end) that have been read.
    struct Read {
        std::uint32_t begin, end;
        RaysByBounce rays;
        std::span<const float> values;  // in the layout of FieldPictures
    };
    std::vector<Read> read;
    std::vector<float> values;  // the memory of `read`, if no FieldPictures holds it
};

struct FieldSaving {
    // The saved state, taken if it has the settings that are to be rendered. A search goes to its settings, which must
    // be within the limits of the search, as soon as it may.
    std::optional<FieldProgress> from = {};
    // Whether to keep the progress now, or, if `is_stopped`, that of a stopped render at its end. This and keep() are
    // called from any thread, one at a time.
    std::function<bool(bool is_stopped)> is_due;
    std::function<void(FieldProgress&)> keep;
    // Called when all pictures of the last kept state are there.
    std::function<void()> has_all = [] {};
};

// Whether both settings make the same pictures.
bool same_pictures(FieldSettings a, const FieldSettings& b);
// Whether a search that ends with `most` may render with `settings`.
bool is_within(const FieldSettings& settings, const FieldSettings& most);

}  // namespace neumann
