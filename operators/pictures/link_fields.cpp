#include "operators/pictures/link_fields.h"

#include <utility>

namespace neumann {

LinkFields::LinkFields(const TracedSeries& series, LinkRaster raster)
    : fine(series.fine),
      coarse(series.coarse),
      kept(*series.fine_by_links),
      fine_replaced(*series.fine_by_links),
      coarse_replaced(*series.coarse_by_links),
      raster(std::move(raster)) {}

void LinkFields::show_as_points(std::size_t bounce, const TracedSeries& series) {
    fine.subtract(bounce, *series.fine_by_links);
    coarse.subtract(bounce, *series.coarse_by_links);
    kept.set_to_zero(bounce);
}

void LinkFields::read_from_fields(std::size_t bounce) {
    fine_replaced.set_to_zero(bounce);
    coarse_replaced.set_to_zero(bounce);
    raster.set_to_zero(bounce);
}

}  // namespace neumann
