#include "operators/experiments/blame/our_path.h"

#include <algorithm>
#include <utility>

namespace neumann {

namespace {

PathVertex vertex_of(const Scene& scene, const PathStep& step, const Vec3& camera) {
    PathVertex vertex{step.to.shape, step.to.position, {}};
    if (step.to.is_infinite()) vertex.position = step.from.position + step.w * (1.0 + glm::length(step.from.position - camera));
    if (const auto seen = scene.camera.see(vertex.position, Vec2(0.5)))
        vertex.film = seen->position - Vec2(scene.film.crop_x, scene.film.crop_y);
    return vertex;
}

// All paths that a sample tried, up to the last of these bounces: each ends at a light sample or at a light.
std::vector<OurPath> paths_of(const Scene& scene, const Replay& replay, std::uint64_t sample, const BounceRange& bounces) {
    std::vector<OurPath> paths;
    OurPath path;
    path.sample = sample;
    for (const auto& [step, found] : replay.steps) {
        if (step.bounce > bounces.last) continue;
        if (step.kind == PathStep::Kind::first) path.camera = step.from.position;
        OurPath ends = path;
        ends.vertices.push_back(vertex_of(scene, step, path.camera));
        ends.bounce = step.bounce;
        ends.is_blocked = step.kind == PathStep::Kind::shadow_ray && !step.found;
        if (step.kind != PathStep::Kind::shadow_ray) path.vertices = ends.vertices;
        for (const auto& f : found)
            if (const auto brings = static_cast<int>(f.quantity); brings >= bounces.first && brings <= bounces.last)
                ends.value += f.value;
        paths.push_back(std::move(ends));
    }
    return paths;
}

}  // namespace

OurPath brightest_path(const Scene& scene, const RecordedSamples& render, std::uint32_t pixel, std::uint64_t samples,
                       const BounceRange& bounces) {
    OurPath best;
    for (std::uint64_t s = 0; s < samples; ++s) {
        const std::vector<OurPath> paths = paths_of(scene, render.replay({pixel, s}), s, bounces);
        if (s == 0 && !paths.empty())
            best = *std::ranges::max_element(paths, {}, [](const OurPath& p) { return std::pair(p.bounce, p.is_blocked); });
        for (const OurPath& path : paths)
            if (mean_component(path.value) > mean_component(best.value)) best = path;
    }
    return best;
}

}  // namespace neumann
