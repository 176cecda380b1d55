#include "operators/render/from_fields/link_fields.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace neumann {

namespace {

// The difference between finer and coarser patches in a bounce's light by links, relative to that light.
struct Blur {
    double with_noise = 0.0, without = 0.0;
};
Blur blur(const std::vector<TracedSeries>& replicates, std::size_t quantity) {
    const PatchSpace &fine = replicates.front().fine_by_links->space(), &coarse = replicates.front().coarse_by_links->space();
    const std::vector<std::uint32_t> around = fine.coarser_of_each(coarse);
    const auto n = static_cast<double>(replicates.size());
    double differences = 0.0, noise = 0.0, all = 0.0;
    for (std::uint32_t u = 0; u < fine.size(); ++u)
        for (std::size_t c = 3 * quantity; c < 3 * quantity + 3; ++c) {
            double value = 0.0, difference = 0.0, squares = 0.0;
            for (const TracedSeries& series : replicates) {
                const double here = (*series.fine_by_links)[u][c], d = here - (*series.coarse_by_links)[around[u]][c];
                value += here / n;
                difference += d / n;
                squares += d * d / n;
            }
            const double measure = fine.measure(fine.facets()[fine.facet_of(u)]);
            differences += measure * difference * difference;
            noise += measure * (squares - difference * difference) / (n - 1.0);
            all += measure * value * value;
        }
    if (!(all > 0.0)) return {};
    return {std::sqrt(differences / all), n > 1.0 ? std::sqrt(std::max(differences - noise, 0.0) / all) : 0.0};
}

}  // namespace

LinkFields::LinkFields(const TracedSeries& series, LinkRaster raster)
    : fine(series.fine),
      coarse(series.coarse),
      kept(*series.fine_by_links),
      fine_replaced(*series.fine_by_links),
      coarse_replaced(*series.coarse_by_links),
      raster(std::move(raster)),
      shown_as_points(series.fine.stride() / 3) {}

void LinkFields::show_as_points(std::size_t bounce, const TracedSeries& series) {
    fine.subtract(bounce, *series.fine_by_links);
    coarse.subtract(bounce, *series.coarse_by_links);
    kept.set_to_zero(bounce);
    shown_as_points[bounce] = true;
}

void LinkFields::read_from_fields(std::size_t bounce) {
    fine_replaced.set_to_zero(bounce);
    coarse_replaced.set_to_zero(bounce);
    raster.set_to_zero(bounce);
}

std::vector<LinkFields> divide_by_links(const std::vector<TracedSeries>& replicates, std::vector<LinkRaster> rasters,
                                        const std::function<double(std::size_t)>& noise_of_points) {
    std::vector<LinkFields> fields;
    for (std::size_t r = 0; r < replicates.size(); ++r) fields.emplace_back(replicates[r], std::move(rasters[r]));
    // A cell of the raster has at least a quarter of enough_ends.
    const double noise_of_raster =
        2.0 / std::sqrt(0.25 * static_cast<double>(LinkRaster::enough_ends) * static_cast<double>(replicates.size()));
    for (std::size_t k = 2; k < fields.front().shown_as_points.size(); ++k) {
        const Blur of_patches = blur(replicates, k);
        const bool by_points = noise_of_points(k) < of_patches.with_noise;
        for (std::size_t r = 0; r < replicates.size(); ++r) {
            if (by_points) fields[r].show_as_points(k, replicates[r]);
            if (of_patches.without < noise_of_raster) fields[r].read_from_fields(k);
        }
    }
    return fields;
}

}  // namespace neumann
