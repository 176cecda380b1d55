#include "operators/paths/photons/photon_points.h"

#include "operators/paths/light/film_splats.h"
#include "operators/paths/photons/photon_paths.h"

#include <oneapi/tbb/parallel_for.h>
#include <atomic>

namespace neumann {

std::vector<PhotonPoint> photon_points(const Scene& scene, int bounces, std::uint32_t paths, std::uint64_t seed,
                                       const Watch& watch) {
    const WalkSettings walk{.bounces = bounces, .rest_probability = 0.0};
    const PhotonTracer tracer(scene, walk, {.paths = paths}, SamplerKind::sobol, seed);
    const std::uint32_t groups = (paths + PhotonTracer::at_once - 1) / PhotonTracer::at_once;
    std::vector<std::vector<PhotonPoint>> parts(groups);
    std::atomic<bool> stopped = false;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, groups, 16), [&](const auto& range) {
        if (stopped || watch.stop()) {
            stopped = true;
            return;
        }
        PhotonTracer::Workspace work;
        for (std::uint32_t group = range.begin(); group < range.end(); ++group) {
            std::vector<PhotonPoint>& part = parts[group];
            std::vector<std::pair<SurfacePoint, CameraEdge>> edges;
            std::vector<std::size_t> owner;
            tracer.trace_group(
                0, group * PhotonTracer::at_once, work,
                [&](int j, std::uint32_t path, const LightWalker& w, bool is_caustic) {
                    const SurfaceSide side = scene.materials.side(w.x, w.wi);
                    if (!side.bsdf || is_delta_only(*side.bsdf)) return;
                    part.push_back({photon_of(w, j, path, 1.0 / paths), is_caustic, {}});
                    if (auto edge = edge_to_lens(scene, 0, w.x, Vec2(0.5))) {
                        edges.emplace_back(w.x, *edge);
                        owner.push_back(part.size() - 1);
                    }
                },
                [](int, std::size_t) {}, NoObserver());
            test_visibility(
                scene.geometry, edges.size(), RayCaster::Rays::any,
                [&](std::size_t k) {
                    return std::pair<const SurfacePoint&, const SurfacePoint&>(edges[k].first, edges[k].second.lens);
                },
                [&](std::size_t k, bool seen) {
                    if (seen) part[owner[k]].pixel = edges[k].second.position;
                });
        }
    });
    if (stopped) throw Stopped();
    std::vector<PhotonPoint> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace neumann
