#include "operators/experiments/unbounce/sorted_walks.h"

#include "operators/paths/walk/path_group.h"
#include "operators/paths/walk/walk.h"
#include "operators/render/from_paths/pixel_samples.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace neumann {

namespace {

struct Find {
    std::uint32_t path;
    std::size_t light;
    int bounce, seen_surfaces;
    Rgb value;
};

// Records the light that walks find: its place on the path, the number of reflections, and the number of these by seen
// surfaces, which are those at which light was found before.
class Sorter : public NoObserver {
public:
    Sorter(const ProjectorLights& projector, std::size_t paths, std::vector<Find>& finds)
        : projector_(projector), finds_(finds), state_(paths) {}

    void casts_shadow_ray(std::uint32_t path, bool, int bounce, const SurfacePoint& x, const Vec3&, const SurfacePoint&,
                          bool) const {
        state_[path].at = x.position;
        state_[path].bounce = bounce;
    }
    void finds(std::uint32_t path, std::size_t quantity, const Rgb& value) const {
        if (quantity == 0 || is_black(value)) return;
        State& of = state_[path];
        finds_.push_back({path, projector_.light_at(of.at), of.bounce, ++of.seen_surfaces, value});
    }

private:
    struct State {
        Vec3 at{0.0};
        int bounce = 0, seen_surfaces = 0;
    };
    const ProjectorLights& projector_;
    std::vector<Find>& finds_;
    mutable std::vector<State> state_;
};

}  // namespace

SortedWalks::SortedWalks(const ProjectorLights& projector, const Scene& scene, const SamplingSettings& settings)
    : projector_(projector),
      scene_(scene),
      settings_(settings),
      layout_(settings.layout(scene.film)),
      direct_(scene, settings.walk.direct) {}

SortedWalks::Part SortedWalks::sample(std::uint64_t part, const Watch& watch) const {
    const auto N = static_cast<std::size_t>(settings_.walk.bounces);
    Part result{std::vector<std::vector<std::pair<std::size_t, Rgb>>>(pixels()), std::vector<Rgb>(pixels(), Rgb(0.0)),
                std::vector<double>(N, 0.0)};
    std::vector<std::vector<double>> of_unseen(layout_.groups(), std::vector<double>(N, 0.0));
    oneapi::tbb::parallel_for(std::uint32_t{0}, layout_.groups(), [&](std::uint32_t number) {
        if (watch.stop()) return;
        const PixelGroup pixels = layout_.group(number);
        PixelSamples samples;
        samples.begin(scene_.film, settings_, layout_, pixels);
        std::vector<Find> finds;
        const Sorter sorter(projector_, pixels.paths(), finds);
        const auto walk_all = [&](auto rays, auto random, Walkers& walkers, TermSamples& out) {
            walk(scene_, scene_.geometry, direct_, settings_.walk, rays, random, walkers, out, MaterialContinuation(), sorter);
        };
        PathGroup paths;
        std::vector<std::uint64_t> rays(N + 2);
        trace(scene_, walk_all, std::span(samples.samplers), std::span<const Pixel>(samples.pixels), part, paths, std::span(rays));

        const double each = 1.0 / pixels.size;
        std::ranges::stable_sort(finds, {}, [&](const Find& f) { return std::pair(f.path / pixels.size, f.light); });
        for (const Find& f : finds) {
            const std::size_t pixel = pixels.begin + f.path / pixels.size;
            const Rgb value = f.value * each;
            auto& of_pixel = result.of_pixel[pixel];
            if (of_pixel.empty() || of_pixel.back().first != f.light) of_pixel.emplace_back(f.light, Rgb(0.0));
            of_pixel.back().second += value;
            if (f.bounce == 1) result.direct[pixel] += value;
            if (f.bounce == f.seen_surfaces) continue;
            const double of_picture = mean_component(value) / static_cast<double>(this->pixels());
            const auto count = [&](int n, double sign) {
                if (n <= static_cast<int>(N)) of_unseen[number][static_cast<std::size_t>(n) - 1] += sign * of_picture;
            };
            count(f.seen_surfaces, 1.0);
            count(f.bounce, -1.0);
        }
    });
    if (watch.stop()) throw Stopped();
    for (const auto& of_group : of_unseen)
        for (std::size_t n = 0; n < N; ++n) result.by_way_of_unseen[n] += of_group[n];
    return result;
}

}  // namespace neumann
