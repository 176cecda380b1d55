// What a sensor is made from, and its film.
#pragma once

#include "core/geometry/ray.h"
#include "core/sensor/pixel_filter.h"

#include <limits>

namespace neumann {

struct Film {
    int width = 768, height = 576;  // the whole film, pixels
    int crop_x = 0, crop_y = 0;     // the part that is rendered
    int crop_width = 768, crop_height = 576;
    PixelFilter filter = GaussianFilter();
    bool sample_border = false;  // whether samples lie beyond the film's edges too, or the filter is cut off there

    // For the pixel (x, y) of the whole film.
    FilmSample sample(const Vec2& u, int x, int y) const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const auto extent = [&](int size) {
            return sample_border ? FilmExtent{-infinity, infinity} : FilmExtent{0.0, double(size)};
        };
        return neumann::sample(filter, u, x, y, extent(width), extent(height));
    }
};

// From the camera into the scene; ends at the far plane.
using CameraRay = Ray;

// The image axis that a field of view is given for.
enum class FovAxis { x, y, diagonal, smaller, larger };
// tan of half the angle across the width of an image of the aspect ratio width / height.
double tan_half_width(double fov, FovAxis axis, double aspect);

struct SensorOptions {
    enum class Kind { perspective, thin_lens, orthographic };

    Mat4 to_world{1.0};  // camera looks along its +z, +y up, +x left (Mitsuba's convention)
    double fov = 0.0;    // full angle, radians; not of `orthographic`
    FovAxis fov_axis = FovAxis::x;
    Vec2 principal_point_offset{0.0};         // relative to the film's size; of `perspective`
    double near_clip = 1e-2, far_clip = 1e4;  // scene units
    Kind kind = Kind::perspective;
    double aperture_radius = 0.0, focus_distance = 0.0;  // scene units; of `thin_lens`
};

}  // namespace neumann
