// The fields of one replicate, divided for reading: where light that comes by links has points or a raster in their place.
#pragma once

#include "operators/fields/matrix/traced_series.h"
#include "operators/render/from_fields/link_raster.h"

#include <functional>
#include <vector>

namespace neumann {

// How one replicate's light that comes by links (link_pictures.h) is shown: in each bounce by the fields like all other light, or
// at pixels as points, and through mirrors and glass from the raster.
struct LinkFields {
    FieldStack fine, coarse;                    // all light but for what pixels have as points
    FieldStack kept;                            // of what comes by links, the rest
    FieldStack fine_replaced, coarse_replaced;  // what the raster has in place of the fields
    LinkRaster raster;
    std::vector<bool> shown_as_points;  // by bounce

    LinkFields(const TracedSeries& series, LinkRaster raster);
    void show_as_points(std::size_t bounce, const TracedSeries& series);
    void read_from_fields(std::size_t bounce);  // and not from the raster
};

// Of all replicates. Patches blur; points and the raster are noisy: each bounce is shown by what errs less. `noise_of_points(k)`:
// the relative error of bounce k as points.
std::vector<LinkFields> divide_by_links(const std::vector<TracedSeries>& replicates, std::vector<LinkRaster> rasters,
                                        const std::function<double(std::size_t)>& noise_of_points);

}  // namespace neumann
