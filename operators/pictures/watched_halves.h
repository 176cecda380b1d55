// T as paths from the lights and both halves of bidirectional ones ask it, which tells an observer of every ray. Which path a ray
// belongs to is told by where its point is kept.
#pragma once

#include "operators/bidirectional/bidirectional.h"
#include "operators/pictures/path_group.h"
#include "operators/pictures/path_observer.h"

#include <array>
#include <optional>

namespace neumann {

class WatchedHalves {
public:
    // Of paths from lights alone there are no `rays`.
    WatchedHalves(const Geometry& T, const LightWalkers& light, const std::vector<CameraWalker>& camera,
                  std::span<const CameraRay> rays, bool splits, PathObserver& observer)
        : T_(&T), light_(&light), camera_(&camera), rays_(rays), splits_(splits), observer_(&observer) {}

    template <class HitAt>
    std::uint32_t first_hits(std::span<const Ray> rays, const HitAt& hit) const {
        const std::uint32_t found = T_->first_hits(rays, hit);
        for (std::size_t j = 0; j < rays.size(); ++j) {
            const auto i = static_cast<std::uint32_t>(&rays[j] - rays_.data());
            SurfacePoint lens;
            lens.position = rays[j].origin;
            camera_half_[i].first = hit(j);
            tell(i, {PathStep::Kind::first, false, 0, lens, rays[j].direction, 0.0, Rgb(1.0), (found >> j & 1u) != 0, hit(j)});
        }
        return found;
    }

    template <class FromAt, class HitAt>
    std::uint32_t first_hits(std::size_t n, const FromAt& from, const HitAt& hit) const {
        std::array<SurfacePoint, RayCaster::packet_size> start;
        for (std::size_t j = 0; j < n; ++j) start[j] = from(j).first;
        const std::uint32_t found = T_->first_hits(n, from, hit);
        for (std::size_t j = 0; j < n; ++j) {
            const bool seen = found >> j & 1u;
            const SurfacePoint& to = hit(j);
            if (const auto i = light_path_at(to)) {
                const LightWalker& w = light_->walker[*i];
                const int bounce = light_half_[*i].bounce++;
                tell(*i, {bounce == 0 ? PathStep::Kind::first : PathStep::Kind::goes_on, true, bounce, start[j], w.w, 0.0, w.beta,
                          seen, to});
            } else {
                const std::uint32_t k = *camera_path_at(to);
                const CameraWalker& z = (*camera_)[k];
                begin_again_at_first_point(k, start[j]);
                tell(k, {PathStep::Kind::goes_on, false, ++camera_half_[k].bounce, start[j], z.w, z.pdf, z.beta, seen, to});
            }
        }
        return found;
    }

    template <class PairAt>
    std::uint32_t visible(std::size_t n, const PairAt& pair, RayCaster::Rays kind) const {
        const std::uint32_t seen = T_->visible(n, pair, kind);
        for (std::size_t j = 0; j < n; ++j) {
            const SurfacePoint &x = pair(j).first, &y = pair(j).second;
            const auto i = light_path_at(x);
            const std::uint32_t path = i ? *i : *camera_path_at(x);
            if (!i) begin_again_at_first_point(path, x);
            const int bounce = i ? light_half_[path].bounce : camera_half_[path].bounce + 1;
            tell(path, {PathStep::Kind::asks, i.has_value(), bounce, x, glm::normalize(y.position - x.position), 0.0, Rgb(0.0),
                        (seen >> j & 1u) != 0, y});
        }
        return seen;
    }

    // What a path's last ray has brought.
    void found(std::uint32_t path, std::size_t quantity, const Rgb& value, const Vec2* pixel) const {
        if (observer_->watches(path)) observer_->found(path, quantity, value, pixel);
    }

private:
    template <class Paths, class PointOf>
    static std::optional<std::uint32_t> path_at(const SurfacePoint& x, const Paths& paths, const PointOf& point) {
        for (std::uint32_t i = 0; i < paths.size(); ++i)
            if (&point(paths[i]) == &x) return i;
        return std::nullopt;
    }
    std::optional<std::uint32_t> light_path_at(const SurfacePoint& x) const {
        return path_at(x, light_->walker, [](const LightWalker& w) -> const SurfacePoint& { return w.x; });
    }
    std::optional<std::uint32_t> camera_path_at(const SurfacePoint& x) const {
        return path_at(x, *camera_, [](const CameraWalker& z) -> const SurfacePoint& { return z.x; });
    }
    // Several walks go on from there.
    void begin_again_at_first_point(std::uint32_t i, const SurfacePoint& x) const {
        if (splits_ && x.position == camera_half_[i].first.position) camera_half_[i].bounce = 0;
    }
    void tell(std::uint32_t i, PathStep step) const {
        if (!observer_->watches(i)) return;
        if (!step.found && step.kind != PathStep::Kind::asks) step.to.shape = SurfacePoint::infinity;
        observer_->step(i, step);
    }

    struct Half {
        int bounce = 0;
        SurfacePoint first;
    };
    const Geometry* T_;
    const LightWalkers* light_;
    const std::vector<CameraWalker>* camera_;
    std::span<const CameraRay> rays_;
    bool splits_;
    PathObserver* observer_;
    mutable std::array<Half, paths_at_once> light_half_{}, camera_half_{};
};

}  // namespace neumann
