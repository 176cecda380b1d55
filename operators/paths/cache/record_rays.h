// The rays of a record: RecordTracer::trace_ray(), and leave_record(), with which the cache is filled and the places of
// records are chosen.
#pragma once

#include "operators/paths/cache/cache_walk.h"
#include "operators/paths/cache/record_tracer.h"

#include <span>
#include <vector>

namespace neumann {

// The pixel number that stands for a record in its random numbers; those of pixels are smaller.
constexpr std::uint32_t pixel_of_record(std::size_t record) { return 0x80000000u + static_cast<std::uint32_t>(record); }

// Casts one ray from x for each sampler, each through its cell of the hemisphere about the frame, the first through
// cell `first`, and moves the walkers to the hits. Calls met(i, walker) for each.
template <class Sampler, class Observer, class Met>
void leave_record(const Scene& scene, const HemisphereCells& cells, const SurfacePoint& x, const Frame& frame, std::size_t first,
                  std::span<Sampler> samplers, PlainWalkers& walkers, const Observer& observer, const Met& met) {
    walkers.begin(samplers.size());
    for (std::size_t i = 0; i < samplers.size(); ++i) {
        Walker& w = walkers.walker[i];
        w.x = x;
        w.w = frame.to_world(cells.direction(first + i, samplers[i].next2()));
        w.pdf = 0.0;
        w.beta = Rgb(1.0);
        w.kept_weight = 0.0;
    }
    walkers.follow(scene.geometry, 0, observer, [&](Walker& w, std::uint32_t i) {
        w.wo = -w.w;
        met(i, w);
        return !w.x.is_infinite();
    });
}

// The ray is followed only as far as the vertex at which it reads the cache.
template <class Observer>
void RecordTracer::trace_ray(std::uint64_t pass, std::uint32_t ray, const Observer& observer) const {
    const std::size_t rays = places_->cells().size(), record = ray / rays, cell = ray % rays;
    const Record& from = places_->records()[record];
    std::vector<Sampler> sampler(1, Sampler(sampler_, points_, seed_, pixel_of_record(record)));
    sampler.front().start(pass * points_.size() + cell);
    PlainWalkers walkers;
    std::vector<std::uint64_t> counted(static_cast<std::size_t>(walk_.bounces) + 2);
    std::uint64_t given_up = 0;
    std::vector<RecordPlaces::NearRecord> near;
    leave_record(*scene_, places_->cells(), from.x, from.frame, cell, std::span(sampler), walkers, observer, [](auto...) {});
    walk_to_records(
        *scene_, *direct_, walk_, std::span(sampler), walkers, counted, given_up,
        [&](std::uint32_t i, const Walker& w, const Vec3& n, const Rgb&, int) {
            places_->find(w.x.position, n, false, 1.0, near);
            if (near.empty()) return false;
            (void)sampler[i].next();  // chooses the record that is read
            return true;
        },
        [](auto...) {}, observer);
}

}  // namespace neumann
