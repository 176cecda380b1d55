// The records of a cache as points for inspection: where they stand, the irradiance they have, and where on the film
// the camera sees them.
#pragma once

#include "operators/paths/cache/record_places.h"

#include <optional>
#include <vector>

namespace neumann {

struct RecordPoint {
    Record record;
    std::vector<Rgb> irradiance;  // E_1 … E_bounces, W·m⁻²
    std::optional<Vec2> pixel;    // as FilmPoint::position; nothing if the point is hidden or outside of the film
};

// All records of a cache, in the order in which they were placed, filled once. The same on any number of threads.
// Throws InputError as RecordPlaces does, and Stopped.
std::vector<RecordPoint> record_points(const Scene& scene, const CacheSettings& settings, int bounces, std::uint64_t seed,
                                       double memory, const Watch& watch = {});

}  // namespace neumann
