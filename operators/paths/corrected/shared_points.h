// Points on diffuse sides that all pixels share, each with unbiased samples ê_k of the fields' errors e_k = K^k Le − f_k for all k,
// or with light K^k Le that no field has (caustics.h).
#pragma once

#include "core/geometry/surface_point.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace neumann {

class SharedPoints {
public:
    struct Point {
        SurfacePoint y;
        Vec3 normal;             // geometric normal of its side
        Vec3 shading;            // shading normal of the side of `normal`
        double inverse_density;  // 1 / (density with which it was drawn), scene units squared
    };
    static constexpr std::size_t candidates = 16;

    // The number of points is a multiple of the number of candidates; those of errors are in the order of the patches. `errors` has
    // for each point ê_1 … ê_N and Σ_{k>N} ê_k, or the light of bounces 1 … N.
    SharedPoints(std::vector<Point> points, std::vector<Rgb> errors);

    std::size_t size() const { return points_.size(); }
    std::size_t fields() const { return errors_.size() / points_.size(); }
    const Point& operator[](std::size_t point) const { return points_[point]; }
    const Rgb* carried_by(std::size_t point) const { return errors_.data() + point * fields(); }

    // The point whose errors a walk reads at x, a surface side with this normal. Among a few candidates that are spread
    // over the list, one is chosen in proportion to what it contributes if it is visible: resampled importance sampling
    // (Talbot, Cline and Egbert, Importance resampling for global illumination, 2005).
    struct Chosen {
        std::uint32_t point;
        // weight · V(x, y) · ê(y) estimates ∫ min(g, c) V e dA, g = cosθx cosθy / (π d²); 0 if no candidate contributes.
        double weight;
    };
    // `clamp` is c, and `u` a random number in [0, 1).
    Chosen choose(const Vec3& x, const Vec3& normal, double clamp, double u) const;

private:
    struct Candidates {
        double x[candidates], y[candidates], z[candidates], nx[candidates], ny[candidates], nz[candidates];
        double size[candidates];   // size of the errors
        double worth[candidates];  // size over density
    };

    std::vector<double> error_sizes() const;

    std::vector<Point> points_;
    std::vector<Rgb> errors_;
    // The k-th candidate of the i-th place in the list is point i + k · places_.size().
    std::vector<Candidates> places_;
};

}  // namespace neumann
