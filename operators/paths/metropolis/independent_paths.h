// Independent bidirectional paths, which give the brightness of each bounce, the states from which its chains start, and the rest.
//
// A path draws two subpaths from numbers u, and has a contribution w C(s, u) for each way (s, t). A chain of bounce k walks among
// the states (s, u) in proportion to f(s, u) = the mean channel of w C(s, u), s + t = k + 2 (Hachisuka, Kaplanyan and Dachsbacher,
// Multiplexed Metropolis Light Transport, 2014), and b_k = E[Σ_s f(s, u)] is the brightness of the bounce.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/bidirectional/bidirectional.h"
#include "operators/paths/metropolis/film_area.h"

#include <algorithm>
#include <vector>

namespace neumann {

// The number of subpaths that are traced together.
constexpr std::uint32_t chains_at_once = 64;

// The contribution of one way, as radiance times the area of the film in pixels, with its MIS weight.
struct WayFound {
    int bounce = 0, s = 0;
    Rgb value{0.0};
    Vec2 position;  // on the film
};
inline double size_of(const Rgb& value) { return (value.r + value.g + value.b) / 3.0; }

class IndependentPaths {
public:
    struct Workspace {
        std::vector<Sampler> camera, light;
        std::vector<CameraRay> rays;
        std::vector<Vec2> positions;
        BidirectionalWork bidirectional;
    };

    // Keeps references to the scene. `paths` is the number of paths in each replicate.
    IndependentPaths(const Scene& scene, const WalkSettings& walk, SamplerKind sampler, std::uint64_t seed, std::uint32_t paths)
        : scene_(&scene),
          area_(scene.film),
          bidirectional_(scene, walk, area_.pixels()),
          net_(stratified),
          kind_(sampler),
          seed_(seed),
          paths_(paths) {}

    std::uint32_t paths() const { return paths_; }
    std::uint32_t groups() const { return (paths_ + chains_at_once - 1) / chains_at_once; }
    std::uint32_t paths_of_group(std::uint32_t group) const { return std::min(chains_at_once, paths_ - group * chains_at_once); }
    const FilmArea& area() const { return area_; }

    // The random numbers of both subpaths of a path come from copies of these samplers, started at number(replicate, path).
    Sampler camera_numbers() const { return Sampler(kind_, net_, seed_, of_camera); }
    Sampler light_numbers() const { return Sampler(kind_, net_, seed_, of_light); }
    std::uint64_t number(std::uint64_t replicate, std::uint32_t path) const {
        return replicate * ((std::uint64_t{paths_} + stratified - 1) / stratified * stratified) + path;
    }

    // Traces the paths of a group and calls found(path, WayFound), with paths numbered from 0 in the group, where there
    // is light. Adds the rays of each bounce and of the rest to `counts`. Returns the number of walks given up.
    template <class OnFound, class Observer = NoObserver>
    std::uint64_t trace_group(std::uint64_t replicate, std::uint32_t group, Workspace& work, const OnFound& found,
                              std::span<std::uint64_t> counts, const Observer& observer = {}) const {
        const std::uint32_t n = paths_of_group(group), first = group * chains_at_once;
        work.camera.assign(n, camera_numbers());
        work.light.assign(n, light_numbers());
        work.rays.clear();
        work.positions.clear();
        for (std::uint32_t i = 0; i < n; ++i) {
            work.camera[i].start(number(replicate, first + i));
            work.light[i].start(number(replicate, first + i));
            work.positions.push_back(area_.at(work.camera[i].next2()));
            work.rays.push_back(scene_->camera.sample_ray(work.positions[i], work.camera[i]));
        }
        const auto tell = [&](std::uint32_t i, const Vec2& position, const WayContribution& f, double measure) {
            const Rgb value = f.value * (f.weight * measure);
            if (!is_black(value)) found(i, WayFound{f.bounce, f.s, value, position});
        };
        return bidirectional_.trace(std::span<const CameraRay>(work.rays), std::span(work.camera), std::span(work.light),
                                    work.bidirectional, Bidirectional::OnFound([&](std::uint32_t i, const WayContribution& f) {
                                        tell(i, work.positions[i], f, area_.pixels() * scene_->camera.response(work.positions[i]));
                                    }),
                                    Bidirectional::OnSplat([&](std::uint32_t i, const Vec2& position, const WayContribution& f) {
                                        if (area_.holds(position)) tell(i, position, f, 1.0);
                                    }),
                                    counts, observer);
    }

private:
    // The number of paths that are stratified together, and the pixel numbers for the random numbers of subpaths.
    static constexpr std::uint32_t stratified = 4096, of_camera = 0xffffffffu, of_light = 0xfffffffeu;

    const Scene* scene_;
    FilmArea area_;
    Bidirectional bidirectional_;
    SobolPoints net_;
    SamplerKind kind_;
    std::uint64_t seed_;
    std::uint32_t paths_;
};

}  // namespace neumann
