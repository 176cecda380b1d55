#include "operators/paths/corrected/caustics.h"

#include "operators/in_order.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// Paths that are stratified together.
constexpr std::uint32_t net = 4096;
// The paths of a replicate whose places carry light to others.
constexpr std::size_t paths_to_points = 1u << 14;
constexpr std::uint64_t lamp_stream = 0x6c616d7073ull;

// The points of the first groups of paths.
struct Points {
    std::vector<SharedPoints::Point> points;
    std::vector<Rgb> carried;  // by each point, f_1 … f_N

    // A mean over all of them is a sum over what `paths` paths bring.
    std::optional<SharedPoints> of(std::size_t paths) {
        if (points.empty()) return std::nullopt;
        const std::size_t N = carried.size() / points.size();
        while (points.size() % SharedPoints::candidates > 0) {
            points.push_back(points.front());
            carried.resize(carried.size() + N, Rgb(0.0));
        }
        for (SharedPoints::Point& point : points)
            point.inverse_density = static_cast<double>(points.size()) / static_cast<double>(paths);
        return std::optional<SharedPoints>(std::in_place, std::move(points), std::move(carried));
    }
};

}  // namespace

Caustics::Caustics(const Scene& scene, int bounces, const FieldRaster* fields, double clamp)
    : scene_(scene),
      fields_(fields),
      clamp_(clamp),
      emission_(scene.geometry, scene.emitters),
      ending_{bounces, {}, 0.0, 0},
      net_(net) {}

std::optional<Caustics::Made> Caustics::make(const CausticAim& aim, std::uint64_t replicate, double samples, SamplerKind sampler,
                                             std::uint64_t seed, const std::function<void(const Seen&)>& seen,
                                             const Watch& watch) const {
    const auto all_groups = static_cast<std::size_t>(std::max(std::ceil(paths_of_sample * samples / at_once), 1.0));
    const std::size_t groups_to_points = std::min(all_groups, paths_to_points / at_once),
                      groups = seen ? all_groups : groups_to_points, N = static_cast<std::size_t>(ending_.bounces),
                      densities = aim.densities();
    const std::uint64_t first = replicate << 32u;
    struct Group {
        std::vector<Seen> seen;
        Points brought;
        std::vector<std::uint64_t> rays;
        std::vector<AimedNumbers> numbers;
        Work work;
    };
    Made made{{}, std::vector<std::uint64_t>(N + 1)};
    Points brought;
    const bool done = add_in_order<Group>(
        groups,
        [&](std::size_t g, Group& group) {
            group.seen.clear();
            group.brought = {};
            group.rays.assign(N + 1, 0);
            group.numbers.clear();
            std::vector<Sampler> samplers;
            for (std::size_t d = 0; d < densities; ++d)
                samplers.emplace_back(sampler, net_, seed ^ lamp_stream, static_cast<std::uint32_t>(d));
            for (std::size_t i = g * at_once; i < (g + 1) * at_once; ++i) {
                samplers[i % densities].start(first + i / densities);
                group.numbers.emplace_back(samplers[i % densities], aim, i % densities);
            }
            trace(
                group.numbers, group.work,
                [&](const CameraEdge& edge, bool, std::size_t bounce) {
                    group.seen.push_back(
                        {edge.position, static_cast<std::uint32_t>(bounce), edge.value / static_cast<double>(groups * at_once)});
                },
                [&](std::uint32_t, int bounce, const LightWalker& w) {
                    if (g >= groups_to_points || bounce > bounces_of_points()) return;
                    const SurfaceSide side = scene_.materials.side(w.x, w.wi);
                    const bool front = glm::dot(w.x.normal, side.p.frame.n) > 0.0;  // of the side that is lit
                    if (!fields_ || !fields_->covers(w.x, front)) return;
                    Points& to = group.brought;
                    to.points.push_back({w.x, front ? w.x.normal : -w.x.normal, side.p.frame.n, 1.0});
                    to.carried.resize(to.points.size() * N, Rgb(0.0));
                    to.carried[to.carried.size() - N + static_cast<std::size_t>(bounce) - 1] =
                        w.beta * geometric_bsdf(side, side.p.frame.n, w.wi);
                },
                group.rays);
        },
        [&](std::size_t, const Group& group) {
            if (seen) std::ranges::for_each(group.seen, seen);
            brought.points.insert(brought.points.end(), group.brought.points.begin(), group.brought.points.end());
            brought.carried.insert(brought.carried.end(), group.brought.carried.begin(), group.brought.carried.end());
            for (std::size_t q = 0; q <= N; ++q) made.rays[q] += group.rays[q];
            return !watch.stop();
        });
    if (!done) return std::nullopt;
    made.points = brought.of(groups_to_points * at_once);
    return made;
}

}  // namespace neumann
