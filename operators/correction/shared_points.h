// Points on diffuse sides that all pixels share, each with unbiased samples ê_k of the fields' errors e_k = K^k Le − f_k for all k.
#pragma once

#include "core/geometry/surface_point.h"

#include <cstddef>
#include <vector>

namespace neumann {

struct SharedPoints {
    struct Point {
        SurfacePoint y;
        Vec3 normal;             // of its side
        double inverse_density;  // 1 / (density with which it was drawn), scene units squared
    };
    std::vector<Point> points;  // in the order of the patches
    std::vector<Rgb> errors;    // point by point: ê_1 … ê_N and Σ_{k>N} ê_k

    std::size_t size() const { return points.size(); }
    std::size_t fields() const { return errors.size() / points.size(); }
    const Rgb* errors_at(std::size_t point) const { return errors.data() + point * fields(); }
};

}  // namespace neumann
