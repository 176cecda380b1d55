// A camera with a lens instead of a pinhole (Mitsuba's `thinlens`): all rays of a film position meet in the plane of focus, at the
// point that the pinhole would see there. A point at depth z blurs to a disc of the radius r |1/f − 1/z| in units of depth 1, where
// r is the lens's radius and f the distance of the plane of focus.
#pragma once

#include "core/sensor/sensor_options.h"

namespace neumann {

class ThinLens {
public:
    ThinLens(const SensorOptions& options, const Film& film);

    CameraRay ray(const Vec2& position, const Vec2& lens) const;
    std::optional<FilmPoint> see(const Vec3& p, const Vec2& lens) const;
    double pixels_per_area(const CameraRay& ray, const Vec3& p) const;

private:
    Vec3 aside(const Vec2& lens) const;

    Vec3 origin_;
    FilmPlane plane_;       // from the centre of the lens to a film position's point in the plane of focus
    Vec3 lens_x_, lens_y_;  // radii of the lens
    Vec3 axis_;
    double near_, far_;
};

}  // namespace neumann
