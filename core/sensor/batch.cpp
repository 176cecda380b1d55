#include "core/sensor/batch.h"

#include "core/sensor/sensor.h"

namespace neumann {

Batch::Batch(const SensorOptions& options, const Film& film, const Geometry* geometry) {
    Film part = film;
    part.width /= static_cast<int>(options.sensors.size());
    width_ = part.width;
    std::vector<Sensor> sensors;
    for (const SensorOptions& sensor : options.sensors) sensors.emplace_back(sensor, part, geometry);
    sensors_ = std::make_shared<const std::vector<Sensor>>(std::move(sensors));
}

// Beyond the film's edges, where samples may lie, the outermost sensors go on.
std::size_t Batch::at(const Vec2& position) const {
    return static_cast<std::size_t>(std::clamp(std::floor(position.x / width_), 0.0, static_cast<double>(sensors_->size()) - 1.0));
}

CameraRay Batch::ray(const Vec2& position, const Vec2& lens) const {
    const std::size_t i = at(position);
    CameraRay ray = (*sensors_)[i].ray(position - corner(i), lens);
    ray.sensor = static_cast<std::uint32_t>(i);
    return ray;
}

std::optional<FilmPoint> Batch::see(const Vec3& p, const Vec2& lens) const {
    const auto count = static_cast<double>(sensors_->size());
    const auto i = static_cast<std::size_t>(std::min(lens.x * count, count - 1.0));
    auto seen = (*sensors_)[i].see(p, {lens.x * count - static_cast<double>(i), lens.y});
    if (!seen) return std::nullopt;
    seen->position += corner(i);
    if (at(seen->position) != i) return std::nullopt;
    seen->weight *= count;
    return seen;
}

double Batch::pixels_per_area(const CameraRay& ray, const Vec3& p) const { return (*sensors_)[ray.sensor].pixels_per_area(ray, p); }

double Batch::response(const Vec2& position) const {
    const std::size_t i = at(position);
    return (*sensors_)[i].response(position - corner(i));
}

}  // namespace neumann
