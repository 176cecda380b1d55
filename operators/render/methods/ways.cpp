#include "operators/render/methods/ways.h"

#include "operators/render/from_paths/splat_sampler.h"

namespace neumann {

Ways render_ways(const Scene& scene, SamplingSettings settings, int bounce, std::uint64_t samples, const Watch& watch) {
    settings.walk.bounces = bounce;
    settings.walk.rest_probability = 0.0;
    settings.method = std::make_shared<const BidirectionalPaths>(BidirectionalPaths::Quantities::ways);
    const RenderedSeries series = render_series(scene, settings, {samples, std::nullopt, std::nullopt}, watch);
    const auto result = series.moments.result();
    const auto picture = [&](std::size_t q) {
        const auto tail = tail_index(series.tally.largest[q]);
        return WayPicture{result.term(q), result.means_of_term(q), tail && tail->variance_is_infinite()};
    };
    Ways out{bounce, {}};
    for (int s = 0; s <= bounce + 1; ++s) {
        const auto q = static_cast<std::size_t>(s);
        out.ways.push_back({s, bounce + 2 - s, picture(q), picture(q + static_cast<std::size_t>(bounce) + 2)});
    }
    return out;
}

}  // namespace neumann
