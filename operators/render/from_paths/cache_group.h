// A group of camera samples of CacheSampler, which advance together.
#pragma once

#include "operators/paths/cache/cache_walk.h"
#include "operators/paths/cache/record_tracer.h"
#include "operators/paths/walk/first_vertices.h"
#include "operators/paths/walk/path_group.h"
#include "operators/render/from_paths/cache_sampler.h"
#include "operators/render/from_paths/pixel_average.h"
#include "operators/render/from_paths/pixel_samples.h"

namespace neumann {

struct CacheSampler::Workspace {
    explicit Workspace(std::size_t quantities) : average(quantities), tally(quantities) {}
    PathGroup group;
    PlainWalkers walkers;
    std::vector<RecordPlaces::NearRecord> near;
    std::vector<Rgb> irradiance;
    PixelSamples samples;
    PixelAverage average;
    Tally tally;
};

// Samples all quantities of these pixels in the replicate into work.group: the terms 0 … N and the rest, and then for
// each term what it loses if the cache is read within wider radii.
template <class Observer>
void CacheSampler::trace_group(std::uint64_t replicate, const PixelGroup& pixels, const CachePass& pass, Workspace& work,
                               const Observer& observer) const {
    work.samples.begin(scene_->film, settings_, layout_, pixels);
    const WalkSettings& walk = settings_.walk;
    const std::size_t terms = settings_.pictures(), Q = settings_.quantities();
    const bool has_rest = walk.rest_probability > 0.0;
    work.irradiance.resize(2 * pass.bounces());
    const auto sample = [&](std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&, TermSamples& out) {
        const auto find = [&](std::uint32_t i, std::size_t q, const Rgb& light) {
            out.quantities[i * Q + q] += light;
            observer.finds(i, q, light);
        };
        const auto read = [&](std::uint32_t i, const Walker& w, const Vec3& n, const Rgb& weight, int bounce) {
            const auto largest = pass.read(w.x.position, n, work.near, work.irradiance);
            if (!largest) return false;
            Rgb all(0.0);
            for (std::size_t k = 1; k <= pass.bounces(); ++k) {
                const std::size_t reflected = static_cast<std::size_t>(bounce) + k, q = std::min(reflected, terms - 1);
                if (reflected >= terms - 1 && !has_rest) break;
                const Rgb &E = work.irradiance[2 * (k - 1)], &of_wide = work.irradiance[2 * (k - 1) + 1];
                if (!is_black(E)) find(i, q, weight * E);
                const Rgb lost = weight * (E - of_wide);
                // A difference that is not finite is found in the term.
                if (is_finite(lost)) out.quantities[i * Q + terms + q] += lost;
                all += weight * E;
            }
            observer.reads(i, static_cast<std::uint32_t>(*largest * records_->cells().size() + pass.brightest_ray(*largest)),
                           std::numeric_limits<std::uint32_t>::max(), all);
            return true;
        };
        find_first_vertices(*scene_, scene_->geometry, rays, work.walkers, out.rays[0], observer,
                            [&](std::uint32_t i, const Rgb& Le) { find(i, 0, Le); });
        walk_to_records(*scene_, *direct_, walk, samplers, work.walkers, out.rays, out.given_up, read, find, observer);
    };
    work.tally.given_up += trace(*scene_, sample, std::span(work.samples.samplers), std::span<const Pixel>(work.samples.pixels),
                                 replicate, work.group, std::span(work.tally.rays));
}

}  // namespace neumann
