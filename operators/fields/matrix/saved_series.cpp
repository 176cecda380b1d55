#include "operators/fields/matrix/saved_series.h"

#include <algorithm>

namespace neumann {

std::size_t SavedSeries::size() const {
    std::size_t size = 0;
    for (const std::span<const float> of : fields) size += of.size();
    return size;
}

SavedSeries saved(const TracedSeries& series) {
    SavedSeries saved{{series.fine.values(), series.coarse.values()},
                      series.fine_by_links.has_value(),
                      series.rest_converges,
                      series.rays,
                      series.light_rays,
                      series.power,
                      {}};
    if (saved.has_links) {
        saved.fields.push_back(series.fine_by_links->values());
        saved.fields.push_back(series.coarse_by_links->values());
    }
    return saved;
}

TracedSeries restored(const SavedSeries& saved, const PatchSpace& space, const PatchSpace& coarser, int bounces) {
    const float* next = saved.numbers.data();
    const auto take = [&](const PatchSpace& of) {
        FieldStack stack(of, bounces);
        std::copy_n(next, stack.values().size(), stack.values().begin());
        next += stack.values().size();
        return stack;
    };
    TracedSeries series{take(space), take(coarser)};
    if (saved.has_links) {
        series.fine_by_links = take(space);
        series.coarse_by_links = take(coarser);
    }
    series.rays = saved.rays;
    series.light_rays = saved.light_rays;
    series.rest_converges = saved.rest_converges;
    series.power = saved.power;
    return series;
}

std::size_t saved_size(const PatchSpace& space, const PatchSpace& coarser, int bounces, bool has_links) {
    const auto of = [&](const PatchSpace& one) {
        return 3 * (static_cast<std::size_t>(bounces) + 2) * (std::size_t{one.size()} + 1);
    };
    return (of(space) + of(coarser)) * (has_links ? 2 : 1);
}

}  // namespace neumann
