#include "core/sensor/batch.h"

#include "core/sensor/sensor.h"

namespace neumann {

Batch::Batch(const SensorOptions& options, const Film& film, const Geometry* geometry) {
    width_ = static_cast<double>(film.width) / static_cast<double>(options.sensors.size());
    Film part = film;
    part.width = std::max(static_cast<int>(width_), 1);
    stretch_ = part.width / width_;
    std::vector<Sensor> sensors;
    for (const SensorOptions& sensor : options.sensors) sensors.emplace_back(sensor, part, geometry);
    sensors_ = std::make_shared<const std::vector<Sensor>>(std::move(sensors));
}

// Samples beyond the film's edges belong to the outermost sensors.
std::size_t Batch::at(const Vec2& position) const {
    return static_cast<std::size_t>(std::clamp(std::floor(position.x / width_), 0.0, static_cast<double>(sensors_->size()) - 1.0));
}

// A sensor whose pixels all measure the same only needs to know where in its pixel a sample lies.
Vec2 Batch::own(std::size_t sensor, const Vec2& position) const {
    if ((*sensors_)[sensor].options().is_even()) return position;
    return {(position.x - static_cast<double>(sensor) * width_) * stretch_, position.y};
}

CameraRay Batch::ray(const Vec2& position, const Vec2& lens) const {
    const std::size_t i = at(position);
    CameraRay ray = (*sensors_)[i].ray(own(i, position), lens);
    ray.sensor = static_cast<std::uint32_t>(i);
    return ray;
}

std::optional<FilmPoint> Batch::see(const Vec3& p, const Vec2& lens) const {
    const auto count = static_cast<double>(sensors_->size());
    const auto i = static_cast<std::size_t>(std::min(lens.x * count, count - 1.0));
    auto seen = (*sensors_)[i].see(p, {lens.x * count - static_cast<double>(i), lens.y});
    if (!seen) return std::nullopt;
    seen->position.x = seen->position.x / stretch_ + static_cast<double>(i) * width_;
    if (at(seen->position) != i) return std::nullopt;
    seen->pixels_per_area /= stretch_;
    seen->weight *= count;
    return seen;
}

double Batch::pixels_per_area(const CameraRay& ray, const Vec3& p) const {
    return (*sensors_)[ray.sensor].pixels_per_area(ray, p) / stretch_;
}

double Batch::response(const Vec2& position) const {
    const std::size_t i = at(position);
    return (*sensors_)[i].response(own(i, position));
}

}  // namespace neumann
