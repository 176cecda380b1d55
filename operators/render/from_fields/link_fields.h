// The fields of one replicate, divided for reading: light by links is in points or in a raster instead of the fields.
#pragma once

#include "operators/fields/matrix/traced_series.h"
#include "operators/render/from_fields/link_raster.h"

#include <functional>
#include <vector>

namespace neumann {

// How one replicate's light that comes by links (link_pictures.h) is shown, chosen for each bounce: by the fields like
// all other light, or as points at pixels and, through mirrors and glass, from the raster.
struct LinkFields {
    FieldStack fine, coarse;                    // all light except that which pixels show as points
    FieldStack kept;                            // light by links that is not shown as points
    FieldStack fine_replaced, coarse_replaced;  // the part of the fields that the raster replaces
    LinkRaster raster;
    std::vector<bool> shown_as_points;  // by bounce

    LinkFields(const TracedSeries& series, LinkRaster raster);
    void show_as_points(std::size_t bounce, const TracedSeries& series);
    void read_from_fields(std::size_t bounce);  // the bounce is then not read from the raster
};

// Divides the fields of all replicates. Patches blur, points and the raster are noisy: each bounce is shown in the way
// that errs less. `noise_of_points(k)`: the relative error of bounce k as points.
std::vector<LinkFields> divide_by_links(const std::vector<TracedSeries>& replicates, std::vector<LinkRaster> rasters,
                                        const std::function<double(std::size_t)>& noise_of_points);

}  // namespace neumann
