#include "core/scene/seen_segment.h"

#include <optional>

namespace neumann {

namespace {

constexpr int samples = 64, halvings = 14;  // 64 · 2¹⁴ = 2²⁰

// The place between `with` and `without` up to which `property` holds.
template <class Property>
double last_with(const Property& property, double with, double without) {
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (with + without);
        (property(middle) ? with : without) = middle;
    }
    return with;
}

}  // namespace

std::vector<SeenPiece> seen_pieces(const Scene& scene, const Vec3& a, const Vec3& b, std::uint32_t sensor) {
    const SensorOptions& options = scene.camera.options();
    const auto sensors = static_cast<double>(options.sensors.size());
    const SensorOptions& own = options.sensors.empty() ? options : options.sensors.at(sensor);
    if (own.is_even()) return {};
    // The first number also chooses the sensor of a batch.
    const Vec2 lens(options.sensors.empty() ? 0.5 : (sensor + 0.5) / sensors, 0.5);

    const auto at = [&](double t) { return a + (b - a) * t; };
    const auto on_film = [&](double t) { return scene.camera.see(at(t), lens); };
    const auto is_on_film = [&](double t) { return on_film(t).has_value(); };
    const auto is_hidden = [&](double t) {
        const FilmPoint seen = *on_film(t);
        SurfacePoint hit;
        return scene.geometry.first_hit(seen.start.position, -seen.w, glm::distance(seen.start.position, at(t)) * (1.0 - 1e-6),
                                        hit);
    };

    // Between two planes lies a single piece.
    std::optional<double> first, last;
    for (int i = 0; i <= samples; ++i)
        if (const double t = static_cast<double>(i) / samples; is_on_film(t)) {
            if (!first) first = t;
            last = t;
        }
    if (!first) return {};
    const double step = 1.0 / samples, begin = *first > 0.0 ? last_with(is_on_film, *first, *first - step) : 0.0,
                 end = *last < 1.0 ? last_with(is_on_film, *last, *last + step) : 1.0;

    std::vector<SeenPiece> pieces;
    const auto middle = [&](int i) { return begin + (end - begin) * (i + 0.5) / samples; };
    double from = begin;
    bool hidden = is_hidden(middle(0));
    const auto add = [&](double to) {
        pieces.push_back({on_film(from)->position, on_film(to)->position, hidden});
        from = to;
    };
    for (int i = 1; i < samples; ++i) {
        if (is_hidden(middle(i)) == hidden) continue;
        add(last_with([&](double t) { return is_hidden(t) == hidden; }, middle(i - 1), middle(i)));
        hidden = !hidden;
    }
    add(end);
    return pieces;
}

}  // namespace neumann
