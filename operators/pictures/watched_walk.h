// T as walk() asks it, which tells an observer of every ray. Which walk a ray belongs to is told by where its point is kept; what
// the walk brings, by what has changed among its samples since its last ray.
#pragma once

#include "operators/pictures/path_observer.h"
#include "operators/walk/walk.h"

#include <array>
#include <optional>

namespace neumann {

class WatchedWalk {
public:
    WatchedWalk(const Geometry& T, std::span<const CameraRay> rays, const Walkers& walkers, std::span<const Rgb> samples,
                bool splits, PathObserver& observer)
        : T_(&T),
          rays_(rays),
          walkers_(&walkers),
          samples_(samples),
          splits_(splits),
          observer_(&observer),
          paths_(rays.size()),
          before_(samples.begin(), samples.end()) {}

    template <class HitAt>
    std::uint32_t first_hits(std::span<const Ray> rays, const HitAt& hit) const {
        const std::uint32_t found = T_->first_hits(rays, hit);
        for (std::size_t j = 0; j < rays.size(); ++j) {
            const auto i = static_cast<std::uint32_t>(&rays[j] - rays_.data());
            SurfacePoint lens;
            lens.position = rays[j].origin;
            first(i, lens, rays[j].direction, found >> j & 1u, hit(j));
        }
        return found;
    }

    template <class FromAt, class HitAt>
    std::uint32_t first_hits(std::size_t n, const FromAt& from, const HitAt& hit) const {
        struct Departure {
            std::optional<std::uint32_t> walk;
            SurfacePoint x;
            Vec3 w;
            bool asks;
        };
        std::array<Departure, RayCaster::packet_size> departures;
        for (std::size_t j = 0; j < n; ++j) {
            const SurfacePoint& x = from(j).first;
            const Vec3& w = from(j).second;
            departures[j] = {walk_at(x), x, w, false};
            if (departures[j].walk) departures[j].asks = &w == &walkers_->walker[*departures[j].walk].asked.w;
        }
        const std::uint32_t found = T_->first_hits(n, from, hit);
        for (std::size_t j = 0; j < n; ++j) {
            const Departure& d = departures[j];
            const bool seen = found >> j & 1u;
            if (!d.walk)  // past a light that the camera does not see
                first(*walk_at(hit(j)), d.x, d.w, seen, hit(j));
            else if (d.asks)
                asks(*d.walk, d.x, d.w, seen, hit(j));
            else
                goes_on(*d.walk, d.x, seen, hit(j));
        }
        return found;
    }

    template <class PairAt>
    std::uint32_t visible(std::size_t n, const PairAt& pair, RayCaster::Rays kind) const {
        const std::uint32_t seen = T_->visible(n, pair, kind);
        for (std::size_t j = 0; j < n; ++j) {
            const SurfacePoint &x = pair(j).first, &y = pair(j).second;
            const std::uint32_t i = *walk_at(x);
            if (&y == &walkers_->walker[i].asked.y)
                asks(i, x, glm::normalize(y.position - x.position), seen >> j & 1u, y);
            else
                goes_on(i, x, seen >> j & 1u, y);
        }
        return seen;
    }

    // After the last ray.
    void finish() const {
        for (std::uint32_t i = 0; i < rays_.size(); ++i) tell_what_was_found(i);
    }

private:
    std::optional<std::uint32_t> walk_at(const SurfacePoint& x) const {
        for (std::uint32_t i = 0; i < rays_.size(); ++i)
            if (&walkers_->walker[i].x == &x) return i;
        return std::nullopt;
    }
    void first(std::uint32_t i, const SurfacePoint& from, const Vec3& w, bool found, const SurfacePoint& to) const {
        paths_[i].first = to;
        tell(i, {PathStep::Kind::first, false, 0, from, w, 0.0, Rgb(1.0), found, to});
    }
    void asks(std::uint32_t i, const SurfacePoint& x, const Vec3& w, bool found, const SurfacePoint& to) const {
        begin_again_at_first_point(i, x);
        tell(i, {PathStep::Kind::asks, false, paths_[i].bounce + 1, x, w, 0.0, Rgb(0.0), found, to});
    }
    void goes_on(std::uint32_t i, const SurfacePoint& x, bool found, const SurfacePoint& to) const {
        begin_again_at_first_point(i, x);
        const Walker& w = walkers_->walker[i];
        tell(i, {PathStep::Kind::goes_on, false, ++paths_[i].bounce, x, w.w, w.pdf, w.beta, found, to});
    }
    // Several walks go on from there.
    void begin_again_at_first_point(std::uint32_t i, const SurfacePoint& x) const {
        if (splits_ && x.position == paths_[i].first.position) paths_[i].bounce = 0;
    }
    void tell(std::uint32_t i, PathStep step) const {
        if (!observer_->watches(i)) return;
        tell_what_was_found(i);
        if (!step.found && step.kind != PathStep::Kind::asks) step.to.shape = SurfacePoint::infinity;
        observer_->step(i, step);
    }
    void tell_what_was_found(std::uint32_t i) const {
        if (!observer_->watches(i)) return;
        const std::size_t quantities = samples_.size() / rays_.size();
        for (std::size_t k = i * quantities; k < (i + 1) * quantities; ++k) {
            if (is_finite(before_[k]) && samples_[k] != before_[k])
                observer_->found(i, k - i * quantities, samples_[k] - before_[k], nullptr);
            before_[k] = samples_[k];
        }
    }

    struct Path {
        int bounce = 0;
        SurfacePoint first;
    };
    const Geometry* T_;
    std::span<const CameraRay> rays_;
    const Walkers* walkers_;
    std::span<const Rgb> samples_;
    bool splits_;
    PathObserver* observer_;
    mutable std::vector<Path> paths_;
    mutable std::vector<Rgb> before_;
};

}  // namespace neumann
