// The sensors: Mitsuba's `perspective`, `thinlens`, `orthographic`, `irradiancemeter`, `distant` and `batch`, and our `hemisphere`.
// They are a closed set, like materials and lights.
#pragma once

#include "core/sensor/batch.h"
#include "core/sensor/distant.h"
#include "core/sensor/hemisphere.h"
#include "core/sensor/irradiance_meter.h"
#include "core/sensor/orthographic.h"
#include "core/sensor/perspective.h"
#include "core/sensor/thin_lens.h"

#include <variant>

namespace neumann {

class Sensor {
public:
    // `geometry` is the scene's. Irradiance meters and distant sensors need it, and it must outlive the sensor.
    Sensor(const SensorOptions& options, const Film& film, const Geometry* geometry = nullptr);

    // `position`: pixels from the upper left corner of the film; `lens`: point on the lens in [0, 1)², if there is a lens.
    CameraRay ray(const Vec2& position, const Vec2& lens = Vec2(0.5)) const {
        return std::visit([&](const auto& sensor) { return sensor.ray(position, lens); }, sensor_);
    }
    // Samples the point on the lens; uses no random numbers if there is no lens.
    template <class Sampler>
    CameraRay sample_ray(const Vec2& position, Sampler& sampler) const {
        return has_lens_ ? ray(position, sampler.next2()) : ray(position);
    }

    // How a point is seen from a point on the lens; nothing if it is not between the near and the far plane. The position may be
    // outside the film, and visibility is not tested.
    std::optional<FilmPoint> see(const Vec3& p, const Vec2& lens) const {
        return std::visit([&](const auto& sensor) { return sensor.see(p, lens); }, sensor_);
    }
    // FilmPoint::pixels_per_area of a point p that this ray has hit; infinite if see() finds no points.
    double pixels_per_area(const CameraRay& ray, const Vec3& p) const {
        return std::visit([&](const auto& sensor) { return sensor.pixels_per_area(ray, p); }, sensor_);
    }
    // The measured value at a position where all rays bring the radiance 1: 1 for cameras, and π for an irradiance.
    double response(const Vec2& position) const;
    double largest_response() const;

    const SensorOptions& options() const { return options_; }
    // Whether `lens` makes a difference.
    bool has_lens() const { return has_lens_; }
    // Whether see() finds the points on surfaces that rays of the sensor hit. It does not for a single ray, nor for a
    // field of view as narrow as that of a `radiancemeter`, in which no point would lie.
    bool can_be_joined() const;

private:
    using Variant = std::variant<Perspective, ThinLens, Orthographic, IrradianceMeter, DistantSensor, Batch, Hemisphere>;
    static Variant make(const SensorOptions& options, const Film& film, const Geometry* geometry);
    Variant sensor_;
    SensorOptions options_;
    bool has_lens_;
};

}  // namespace neumann
