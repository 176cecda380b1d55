// The pinhole camera (Mitsuba's `perspective`) and its film.
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

class Perspective {
public:
    enum class FovAxis { x, y, diagonal, smaller, larger };

    struct Options {
        Mat4 to_world{1.0};  // camera looks along its +z, +y up, +x left (Mitsuba's convention)
        double fov = 0.0;    // full angle, radians
        FovAxis fov_axis = FovAxis::x;
        Vec2 principal_point_offset{0.0};         // relative to the film's size
        double near_clip = 1e-2, far_clip = 1e4;  // scene units
    };

    Perspective(const Options& options, const Film& film);

    // `position`: pixels from the upper left corner of the film.
    CameraRay ray(const Vec2& position) const;

private:
    Vec3 origin_, corner_, across_, down_;  // direction towards a film position before normalising, z component 1 in camera space
    Vec3 axis_;
    double near_, far_;
};

}  // namespace neumann
