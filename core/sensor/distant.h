// The radiance that leaves the scene in one direction, averaged over what is looked at (Mitsuba's `distant`): the disc of the
// sphere around the scene that lies across the direction, a shape, uniformly by its area, or a single point. Rays come from beyond
// the scene and end at the first surface in their way. All pixels measure the same.
#pragma once

#include "core/geometry/area_sampler.h"
#include "core/sensor/even_film.h"

namespace neumann {

class DistantSensor {
public:
    // Looks along +z of to_world. Throws InputError if the target is a shape without area.
    DistantSensor(const SensorOptions& options, const Film& film, const Geometry& scene);

    CameraRay ray(const Vec2& position, const Vec2&) const;
    std::optional<FilmPoint> see(const Vec3& p, const Vec2& lens) const;
    double pixels_per_area(const CameraRay&, const Vec3& p) const { return film_.pixels() * density(p); }
    // Whether there is one ray only, of which see() finds no point.
    bool is_single_ray() const { return std::holds_alternative<Vec3>(target_); }

private:
    struct Target {
        explicit Target(const Shape& shape) : geometry({shape}), points(geometry, 0) {}
        Geometry geometry;
        AreaSampler points;
    };

    Vec3 aim(const Vec2& u) const;
    // The density of the rays at p, per area perpendicular to them; infinite for a single ray.
    double density(const Vec3& p) const;
    Vec3 beyond_scene(const Vec3& p) const;

    Vec3 direction_, center_;
    double radius_;
    std::variant<std::monostate, Vec3, std::shared_ptr<const Target>> target_;
    EvenFilm film_;
};

}  // namespace neumann
