#include "operators/paths/cache/record_points.h"

#include "operators/paths/cache/record_tracer.h"
#include "operators/paths/light/film_splats.h"

namespace neumann {

std::vector<RecordPoint> record_points(const Scene& scene, const CacheSettings& settings, int bounces, std::uint64_t seed,
                                       double memory, const Watch& watch) {
    const auto places = std::make_shared<const RecordPlaces>(scene, settings, SamplerKind::sobol, seed, memory, watch);
    // The irradiance E_k of a record is bounce k + 1 once it is reflected.
    const WalkSettings walk{.bounces = bounces + 1, .rest_probability = 0.0};
    const RecordTracer tracer(scene, std::make_shared<const DirectLightSampler>(scene, walk.direct), walk, places,
                              SamplerKind::sobol, seed);
    std::vector<std::uint64_t> rays(static_cast<std::size_t>(bounces) + 3);
    std::uint64_t given_up = 0;
    const auto pass = tracer.trace(0, rays, given_up, watch.stop);
    if (!pass) throw Stopped();
    std::vector<RecordPoint> points;
    std::vector<CameraEdge> edges;
    std::vector<std::size_t> owner;
    for (std::size_t i = 0; i < places->records().size(); ++i) {
        RecordPoint& point = points.emplace_back(RecordPoint{places->records()[i], {}, {}});
        for (std::size_t k = 1; k <= pass->bounces(); ++k) point.irradiance.emplace_back(pass->of(CachePass::narrow, k)[i].value);
        if (auto edge = edge_to_lens(scene, 0, point.record.x, Vec2(0.5))) {
            edges.push_back(*edge);
            owner.push_back(i);
        }
    }
    test_visibility(
        scene.geometry, edges.size(), RayCaster::Rays::any,
        [&](std::size_t k) {
            return std::pair<const SurfacePoint&, const SurfacePoint&>(points[owner[k]].record.x, edges[k].lens);
        },
        [&](std::size_t k, bool seen) {
            if (seen) points[owner[k]].pixel = edges[k].position;
        });
    return points;
}

}  // namespace neumann
