#include "operators/render/from_fields/field_costs.h"

#include "operators/render/from_fields/field_memory.h"

#include <algorithm>

namespace neumann {

void FieldCosts::Line::add(double more_work, double took) {
    // Two measurements give slope and constant; noise in short ones must not make the slope negative.
    if (more_work > 1.2 * work && work > 0.0)
        slope = std::clamp((took - seconds) / (more_work - work), 0.0, took / more_work);
    else if (work == 0.0)
        slope = took / more_work;
    work = more_work;
    seconds = took;
}

double FieldCosts::scale(const FieldSettings& settings) const {
    return static_cast<double>(settings.patching.patches) / static_cast<double>(requested_);
}

// The number of rays of T: at least one per cell of directions.
double FieldCosts::table(const FieldSettings& settings) const {
    double rays = 0.0;
    for (const auto& [cells, count] : sides_) rays += static_cast<double>(count) * std::max(settings.rays, cells);
    return rays * scale(settings);
}

void FieldCosts::add(const FieldSettings& settings, const FieldPictures& pictures, double seconds) {
    sides_ = pictures.sides;
    patches_ = pictures.patches;
    unknowns_ = pictures.unknowns;
    has_links_ = pictures.has_links;
    requested_ = settings.patching.patches;
    fields_.add(table(settings), pictures.field_seconds);
    pictures_.add(settings.samples, pictures.picture_seconds);
    other_ = std::max(seconds - pictures.field_seconds - pictures.picture_seconds, 0.0);
}

FieldCost FieldCosts::predict(const FieldSettings& settings) const {
    const FieldSizes sizes{static_cast<double>(patches_) * scale(settings), static_cast<double>(unknowns_) * scale(settings),
                           table(settings), has_links_};
    return {fields_.at(table(settings)) + pictures_.at(settings.samples) + other_,
            bytes_of_fields(settings, sizes) + 2.0 * bytes_of_pictures(settings, *film_)};
}

}  // namespace neumann
