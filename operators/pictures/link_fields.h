// The fields of one replicate, divided for reading: where light that comes by links has points or a raster in their place.
#pragma once

#include "operators/matrix/traced_series.h"
#include "operators/pictures/link_raster.h"

namespace neumann {

// How one replicate's light that comes by links (link_pictures.h) is shown: in each bounce by the fields like all other light, or
// at pixels as points, and through mirrors and glass from the raster.
struct LinkFields {
    FieldStack fine, coarse;                    // all light but for what pixels have as points
    FieldStack kept;                            // of what comes by links, the rest
    FieldStack fine_replaced, coarse_replaced;  // what the raster has in place of the fields
    LinkRaster raster;

    LinkFields(const TracedSeries& series, LinkRaster raster);
    void show_as_points(std::size_t bounce, const TracedSeries& series);
    void read_from_fields(std::size_t bounce);  // and not from the raster
};

}  // namespace neumann
