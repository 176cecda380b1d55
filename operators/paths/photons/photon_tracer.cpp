#include "operators/paths/photons/photon_tracer.h"

#include "operators/paths/photons/photon_paths.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <atomic>

namespace neumann {

namespace {

void add(std::vector<double>& to, std::size_t at, double x) {
    if (to.size() <= at) to.resize(at + 1, 0.0);
    to[at] += x;
}

void add(std::vector<double>& to, const std::vector<double>& from) {
    for (std::size_t i = 0; i < from.size(); ++i) add(to, i, from[i]);
}

}  // namespace

PhotonTracer::PhotonTracer(const Scene& scene, const WalkSettings& walk, const PhotonSettings& settings, SamplerKind sampler,
                           std::uint64_t seed)
    : scene_(&scene),
      walk_(walk),
      settings_(settings),
      sampler_(sampler),
      seed_(seed),
      emission_(scene.geometry, scene.emitters),
      points_(net) {}

std::optional<PhotonTracer::Photons> PhotonTracer::trace(std::uint64_t pass, const std::function<bool()>& stop) const {
    const double share = 1.0 / settings_.paths;
    const std::uint32_t groups = (settings_.paths + at_once - 1) / at_once;
    const std::size_t last = static_cast<std::size_t>(walk_.bounces) + 1;
    std::vector<Photons> parts(groups);
    std::atomic<bool> stopped = false;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, groups, 16), [&](const auto& range) {
        if (stopped || stop()) {
            stopped = true;
            return;
        }
        Workspace work;
        for (std::uint32_t group = range.begin(); group < range.end() && !stopped; ++group) {
            if (stop()) stopped = true;
            Photons& part = parts[group];
            part.rays.assign(last + 1, 0);
            const auto visit = [&](int j, std::uint32_t path, const LightWalker& w, bool is_caustic) {
                part.reach_something = true;
                add(part.power.arrived, static_cast<std::size_t>(j), mean_component(w.beta) * share);
                const SurfaceSide side = scene_->materials.side(w.x, w.wi);
                if (!side.bsdf || is_delta_only(*side.bsdf)) return;
                const Photon photon = photon_of(w, j, path, share);
                if (is_caustic) part.caustic.push_back(photon);
                if (settings_.gather || (j > 1 && !is_caustic)) part.others.push_back(photon);
            };
            const auto count_rays = [&](int j, std::size_t n) {
                const auto to = static_cast<std::size_t>(j);
                part.rays[std::min(to, last)] += n;
                for (const std::uint32_t i : work.walkers.alive)
                    add(part.power.went_on, to - 1, mean_component(work.walkers.walker[i].beta) * share);
            };
            part.given_up = trace_group(pass, group * at_once, work, visit, count_rays, NoObserver());
        }
    });
    if (stopped) return std::nullopt;
    Photons all;
    all.rays.assign(last + 1, 0);
    for (Photons& counted : parts) {
        const Photons part = std::move(counted);  // freed when it is copied
        all.caustic.insert(all.caustic.end(), part.caustic.begin(), part.caustic.end());
        all.others.insert(all.others.end(), part.others.begin(), part.others.end());
        for (std::size_t q = 0; q <= last; ++q) all.rays[q] += part.rays[q];
        all.given_up += part.given_up;
        all.reach_something = all.reach_something || part.reach_something;
        add(all.power.went_on, part.power.went_on);
        add(all.power.arrived, part.power.arrived);
    }
    return all;
}

}  // namespace neumann
