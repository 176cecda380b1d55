// Who looks: Mitsuba's `perspective`, `thinlens` and `orthographic`. A closed set, as materials and lights are.
#pragma once

#include "core/sensor/orthographic.h"
#include "core/sensor/perspective.h"
#include "core/sensor/thin_lens.h"

#include <variant>

namespace neumann {

class Sensor {
public:
    Sensor(const SensorOptions& options, const Film& film);

    // `position`: pixels from the upper left corner of the film; `lens`: the place on the lens, where there is one.
    CameraRay ray(const Vec2& position, const Vec2& lens = Vec2(0.5)) const {
        return std::visit([&](const auto& sensor) { return sensor.ray(position, lens); }, sensor_);
    }
    // Draws the place on the lens; asks for no numbers where there is none.
    template <class Sampler>
    CameraRay sample_ray(const Vec2& position, Sampler& sampler) const {
        return std::holds_alternative<ThinLens>(sensor_) ? ray(position, sampler.next2()) : ray(position);
    }

    // How a point is seen, from that place on the lens; nothing where it is not between the camera's planes. The film may end
    // before the position, and something may stand in between.
    std::optional<FilmPoint> see(const Vec3& p, const Vec2& lens) const {
        return std::visit([&](const auto& sensor) { return sensor.see(p, lens); }, sensor_);
    }
    // FilmPoint::pixels_per_area of a point that one of its rays has met.
    double pixels_per_area(const CameraRay& ray, const Vec3& p) const {
        return std::visit([&](const auto& sensor) { return sensor.pixels_per_area(ray, p); }, sensor_);
    }
    bool has_lens() const { return std::holds_alternative<ThinLens>(sensor_); }

private:
    using Variant = std::variant<Perspective, ThinLens, Orthographic>;
    static Variant make(const SensorOptions& options, const Film& film);
    Variant sensor_;
};

}  // namespace neumann
