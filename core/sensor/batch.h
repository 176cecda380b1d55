// Several sensors side by side on one film (Mitsuba's `batch`), each with a part of the same width. A filter that is wider than a
// pixel mixes their pictures where they meet, as in Mitsuba.
#pragma once

#include "core/sensor/sensor_options.h"

namespace neumann {

class Geometry;
class Sensor;

class Batch {
public:
    // If the film's width is no multiple of the number of sensors, as for some small trial pictures, the pictures are
    // stretched a little.
    Batch(const SensorOptions& options, const Film& film, const Geometry* geometry);

    CameraRay ray(const Vec2& position, const Vec2& lens) const;
    // How one of the sensors, which `lens` chooses, sees a point.
    std::optional<FilmPoint> see(const Vec3& p, const Vec2& lens) const;
    double pixels_per_area(const CameraRay& ray, const Vec3& p) const;
    double response(const Vec2& position) const;
    const std::vector<Sensor>& sensors() const { return *sensors_; }

private:
    std::size_t at(const Vec2& position) const;
    // The position on the sensor's own film.
    Vec2 own(std::size_t sensor, const Vec2& position) const;

    std::shared_ptr<const std::vector<Sensor>> sensors_;
    double width_, stretch_;  // of each part, in pixels; the width of the sensor's own film over that
};

}  // namespace neumann
