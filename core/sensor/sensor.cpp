#include "core/sensor/sensor.h"

#include <algorithm>
#include <stdexcept>

namespace neumann {

Sensor::Sensor(const SensorOptions& options, const Film& film, const Geometry* geometry)
    : sensor_(make(options, film, geometry)),
      options_(options),
      has_lens_(!std::holds_alternative<Perspective>(sensor_) && !std::holds_alternative<Orthographic>(sensor_) &&
                !std::holds_alternative<Hemisphere>(sensor_)) {}

Sensor::Variant Sensor::make(const SensorOptions& options, const Film& film, const Geometry* geometry) {
    const auto scene = [&]() -> const Geometry& {
        if (!geometry) throw std::logic_error("Sensor: it measures a scene, and there is none");
        return *geometry;
    };
    switch (options.kind) {
        case SensorOptions::Kind::perspective:
            break;
        case SensorOptions::Kind::thin_lens:
            return ThinLens(options, film);
        case SensorOptions::Kind::orthographic:
            return Orthographic(options, film);
        case SensorOptions::Kind::irradiance_meter:
            return IrradianceMeter(scene(), options.shape, film);
        case SensorOptions::Kind::distant:
            return DistantSensor(options, film, scene());
        case SensorOptions::Kind::batch:
            return Batch(options, film, geometry);
        case SensorOptions::Kind::hemisphere:
            return Hemisphere(options, film);
    }
    return Perspective(options, film);
}

double Sensor::response(const Vec2& position) const {
    if (const auto* meter = std::get_if<IrradianceMeter>(&sensor_)) return meter->response();
    if (const auto* batch = std::get_if<Batch>(&sensor_)) return batch->response(position);
    if (const auto* hemisphere = std::get_if<Hemisphere>(&sensor_)) return hemisphere->response(position);
    return 1.0;
}

double Sensor::largest_response() const {
    const auto* batch = std::get_if<Batch>(&sensor_);
    if (std::holds_alternative<Hemisphere>(sensor_)) return 1.0;
    if (!batch) return response(Vec2(0.0));
    double largest = 0.0;
    for (const Sensor& sensor : batch->sensors()) largest = std::max(largest, sensor.largest_response());
    return largest;
}

bool Sensor::can_be_joined() const {
    // Such a sensor sees 1e-11 of the directions around it.
    constexpr double narrow = 1e-5;  // radians
    if (std::holds_alternative<Perspective>(sensor_) && options_.fov < narrow) return false;
    if (const auto* distant = std::get_if<DistantSensor>(&sensor_)) return !distant->is_single_ray();
    const auto* batch = std::get_if<Batch>(&sensor_);
    return !batch || std::ranges::all_of(batch->sensors(), [](const Sensor& sensor) { return sensor.can_be_joined(); });
}

}  // namespace neumann
