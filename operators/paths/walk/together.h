// Paths that advance together (as in wavefront path tracing), one reflection at a time: R for all, then T for all, so
// that the processor always has several independent chains of arithmetic to work on.
#pragma once

#include "core/geometry/geometry.h"
#include "core/sensor/sensor_options.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace neumann {

// `Walker` derives from PathEnd, adds the state that its kind of path needs, and has a constant `from_light`.
template <class Walker>
struct Together {
    std::vector<Walker> walker;        // one for each path; begin() does not reset them
    std::vector<std::uint32_t> alive;  // indices of the paths that go on, ascending

    void begin(std::size_t count) {
        walker.resize(count);
        alive.resize(count);
        std::iota(alive.begin(), alive.end(), 0u);
    }
    // Keeps the paths for which f(walker, index) is true.
    template <class Keep>
    void keep_if(const Keep& f) {
        Walker* const all = walker.data();
        std::uint32_t* const live = alive.data();
        std::size_t kept = 0;
        for (std::size_t k = 0, n = alive.size(); k < n; ++k) {
            const std::uint32_t i = live[k];
            live[kept] = i;
            kept += f(all[i], i);
        }
        alive.resize(kept);
    }

    // Moves each path to its next point, packet by packet, and then does keep_if(f). find_next(k, n, point) finds the next points
    // of alive[k … k + n), writes them to point(j), and returns a bit mask of those found; the others move to infinity.
    template <class Observer, class FindNext, class Keep>
    void advance(int reflections, const Observer& observer, const FindNext& find_next, const Keep& f) {
        constexpr std::size_t packet = RayCaster::packet_size;
        Walker* const all = walker.data();
        std::uint32_t* const live = alive.data();
        std::size_t kept = 0;
        for (std::size_t k = 0, count = alive.size(); k < count; k += packet) {
            const std::size_t n = std::min(packet, count - k);
            for (std::size_t j = 0; j < n; ++j) observer.casts(live[k + j], Walker::from_light, reflections, all[live[k + j]]);
            const std::uint32_t found = find_next(k, n, [&](std::size_t j) -> SurfacePoint& { return all[live[k + j]].x; });
            for (std::size_t j = 0; j < n; ++j) {
                const std::uint32_t i = live[k + j];
                if (!(found >> j & 1u)) all[i].x.shape = SurfacePoint::infinity;
                observer.meets(i, all[i].x);
                live[kept] = i;
                kept += f(all[i], i);
            }
        }
        alive.resize(kept);
    }
    // A `find_next` for advance() that finds the first hits from x along w, which is T.
    template <class Transport, class HitAt>
    std::uint32_t first_hits(const Transport& T, std::size_t k, std::size_t n, const HitAt& hit) const {
        return T.first_hits(
            n,
            [all = walker.data(), some = alive.data() + k](std::size_t j) {
                const Walker& w = all[some[j]];
                return std::pair<const SurfacePoint&, const Vec3&>(w.x, w.w);
            },
            hit);
    }
    template <class Transport, class Observer, class Keep>
    void follow(const Transport& T, int reflections, const Observer& observer, const Keep& f) {
        advance(
            reflections, observer, [&](std::size_t k, std::size_t n, const auto& hit) { return first_hits(T, k, n, hit); }, f);
    }
    // Starts paths along camera rays and moves them to the first hits.
    template <class Transport, class Observer, class Keep>
    void set_out(const Transport& T, std::span<const CameraRay> rays, const Observer& observer, const Keep& f) {
        begin_with(rays);
        advance(
            0, observer, [&](std::size_t k, std::size_t n, const auto& hit) { return T.first_hits(rays.subspan(k, n), hit); }, f);
    }
    // Starts only those paths for which sets_out(index) is true.
    template <class Transport, class SetsOut, class Observer, class Keep>
    void set_out_some(const Transport& T, std::span<const CameraRay> rays, const SetsOut& sets_out, const Observer& observer,
                      const Keep& f) {
        begin_with(rays);
        keep_if([&](const Walker&, std::uint32_t i) { return sets_out(i); });
        std::array<CameraRay, RayCaster::packet_size> packet;
        advance(
            0, observer,
            [&](std::size_t k, std::size_t n, const auto& hit) {
                for (std::size_t j = 0; j < n; ++j) packet[j] = rays[alive[k + j]];
                return T.first_hits(std::span<const CameraRay>(packet.data(), n), hit);
            },
            f);
    }

    // These two save and restore the state at the first vertex, from which several walks start.
    void remember_first() {
        first_ = walker;
        first_alive_ = alive;
    }
    void return_to_first() {
        walker = first_;
        alive = first_alive_;
    }

private:
    void begin_with(std::span<const CameraRay> rays) {
        begin(rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i) {
            walker[i].x.position = rays[i].origin;
            walker[i].w = rays[i].direction;
            walker[i].pdf = 0.0;
            walker[i].beta = Rgb(1.0);
        }
    }

    std::vector<Walker> first_;
    std::vector<std::uint32_t> first_alive_;
};

}  // namespace neumann
