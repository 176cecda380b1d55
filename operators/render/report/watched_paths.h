// Converts the callbacks of operators/paths/walk/observer.h to the steps of a PathObserver.
#pragma once

#include "operators/paths/walk/observer.h"
#include "operators/paths/walk/path_observer.h"

#include <vector>

namespace neumann {

class WatchedPaths : public NoObserver {
public:
    explicit WatchedPaths(PathObserver& observer) : observer_(&observer) {}

    void casts(std::uint32_t path, bool from_light, int reflections, const PathEnd& end) const {
        if (!observer_->watches(path)) return;
        if (path >= waiting_.size()) waiting_.resize(path + 1);
        const auto kind = reflections == 0 ? PathStep::Kind::first : PathStep::Kind::goes_on;
        waiting_[path] = {kind, from_light, reflections, end.x, end.w, end.pdf, end.beta, false, {}};
    }
    void meets(std::uint32_t path, const SurfacePoint& y) const {
        if (!observer_->watches(path)) return;
        PathStep& step = waiting_[path];
        step.found = !y.is_infinite();
        step.to = y;
        observer_->step(path, step);
    }
    void casts_shadow_ray(std::uint32_t path, bool from_light, int bounce, const SurfacePoint& x, const Vec3& w,
                          const SurfacePoint& y, bool seen) const {
        if (!observer_->watches(path)) return;
        observer_->step(path, {PathStep::Kind::shadow_ray, from_light, bounce, x, glm::normalize(w), 0.0, Rgb(0.0), seen, y});
    }
    void joins(std::uint32_t path, int bounce, const SurfacePoint& x, const SurfacePoint& y, bool seen) const {
        if (!observer_->watches(path)) return;
        PathStep step{
            PathStep::Kind::shadow_ray, false, bounce, x, glm::normalize(y.position - x.position), 0.0, Rgb(0.0), seen, y};
        step.is_shared = true;
        observer_->step(path, step);
    }
    void finds(std::uint32_t path, std::size_t quantity, const Rgb& value) const {
        if (observer_->watches(path) && !is_black(value)) observer_->found(path, quantity, value, nullptr);
    }
    void reads(std::uint32_t path, std::uint32_t read_path, std::uint32_t vertex, const Rgb& value) const {
        if (observer_->watches(path)) observer_->read(path, read_path, vertex, value);
    }

private:
    PathObserver* observer_;
    mutable std::vector<PathStep> waiting_;  // for each path, the ray that was cast last
};

}  // namespace neumann
