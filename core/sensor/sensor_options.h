// The options of a sensor, and its film.
#pragma once

#include "core/geometry/ray.h"
#include "core/geometry/shape.h"
#include "core/geometry/surface_point.h"
#include "core/sensor/pixel_filter.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace neumann {

struct Film {
    int width = 768, height = 576;  // the whole film, pixels
    int crop_x = 0, crop_y = 0;     // the part that is rendered
    int crop_width = 768, crop_height = 576;
    PixelFilter filter = GaussianFilter();
    bool sample_border = false;  // samples may lie beyond the film's edges; otherwise the filter is cut off there

    // Samples the filter of pixel (x, y) of the whole film.
    FilmSample sample(const Vec2& u, int x, int y) const { return neumann::sample(filter, u, x, y, extent(width), extent(height)); }
    // The filter's weights of a position on the film for column x and for row y; the weight for pixel (x, y) is their product.
    double weight_across(double position, int x) const { return weight(filter, position, x, extent(width)); }
    double weight_down(double position, int y) const { return weight(filter, position, y, extent(height)); }
    // Whether light at this position contributes to any pixel.
    bool holds(const Vec2& position) const {
        return sample_border || (position.x >= 0.0 && position.x < width && position.y >= 0.0 && position.y < height);
    }

private:
    FilmExtent extent(int size) const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        return sample_border ? FilmExtent{-infinity, infinity} : FilmExtent{0.0, double(size)};
    }
};

// A ray from the camera into the scene; it ends at the far plane.
struct CameraRay : Ray {
    double cosine = 1.0;       // between the ray and the normal of the surface where it starts, if there is one
    std::uint32_t sensor = 0;  // index in a batch
};

// How the camera sees a point: the reversed camera ray through it.
struct FilmPoint {
    Vec2 position;           // position on the film, pixels from the upper left corner
    SurfacePoint start;      // origin of the camera ray
    Vec3 w;                  // from the point to the camera, unit length
    double pixels_per_area;  // film area in pixels per area at the point that faces the camera
    double weight = 1.0;     // the sensor's response, over the probability of choosing it among several
};

// A plane with coordinates: a corner and two spanning vectors.
class FilmPlane {
public:
    FilmPlane(const Vec3& corner, const Vec3& across, const Vec3& down);

    Vec3 at(const Vec2& position) const { return corner_ + across_ * position.x + down_ * position.y; }
    // The inverse, for a point in the plane.
    Vec2 position(const Vec3& p) const { return {glm::dot(p - corner_, dual_across_), glm::dot(p - corner_, dual_down_)}; }
    // The same plane, relative to another origin.
    FilmPlane from(const Vec3& origin) const {
        FilmPlane moved = *this;
        moved.corner_ -= origin;
        return moved;
    }
    // Unit normal, of either sign.
    const Vec3& normal() const { return normal_; }
    const Vec3& corner() const { return corner_; }
    // Area of a pixel in the plane.
    double area() const { return area_; }
    // Pixels per solid angle, seen from the plane's origin along a direction of unit length.
    double pixels_per_solid_angle(const Vec3& direction) const {
        const double cosine = std::abs(glm::dot(direction, normal_)), distance = std::abs(glm::dot(corner_, normal_)) / cosine;
        return distance * distance / (area_ * cosine);
    }

private:
    Vec3 corner_, across_, down_, dual_across_, dual_down_, normal_;
    double area_;
};

// The image axis to which a field of view applies.
enum class FovAxis { x, y, diagonal, smaller, larger };
// tan of half the angle across the width of an image of the aspect ratio width / height.
double tan_half_width(double fov, FovAxis axis, double aspect);

struct SensorOptions {
    enum class Kind { perspective, thin_lens, orthographic, irradiance_meter, distant, batch, hemisphere };

    Mat4 to_world{1.0};  // camera looks along its +z, +y up, +x left (Mitsuba's convention)
    double fov = 0.0;    // full angle, radians; not used by `orthographic`
    FovAxis fov_axis = FovAxis::x;
    Vec2 principal_point_offset{0.0};         // relative to the film's size; for `perspective`
    double near_clip = 1e-2, far_clip = 1e4;  // scene units
    Kind kind = Kind::perspective;
    double aperture_radius = 0.0, focus_distance = 0.0;  // scene units; for `thin_lens`
    std::uint32_t shape = 0;                             // index of the shape on which an `irradiance_meter` lies
    // The target of `distant`: all of the scene, a point, or a shape, which need not be in the scene.
    std::variant<std::monostate, Vec3, std::shared_ptr<const Shape>> target = {};
    std::vector<SensorOptions> sensors = {};  // parts of a `batch`, from left to right

    // Whether all pixels measure the same.
    bool is_even() const { return kind == Kind::irradiance_meter || kind == Kind::distant; }
    bool has(Kind wanted) const {
        return kind == wanted || std::any_of(sensors.begin(), sensors.end(), [&](const auto& s) { return s.has(wanted); });
    }
};

// The film as the sensor needs it. A sensor whose pixels all measure the same takes the places of samples within their
// pixels as random numbers, so its film has the box filter.
inline Film film_of(const SensorOptions& options, Film film) {
    if (options.is_even()) film.filter = BoxFilter();
    return film;
}

}  // namespace neumann
