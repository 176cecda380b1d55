// Light from infinitely far away by a picture of all directions (Mitsuba's `envmap`): column by longitude, row by latitude, the
// first and the last row the poles. In the map's own space +y is up, the middle of the picture looks along +z and its left quarter
// along +x. Between pixels the radiance is bilinear in the angles.
//
// Directions are sampled in proportion to luminance,
//
//     p(ω) = Y(ω) s(θ) / (sinθ ∫∫ Y s dθ dφ),
//
// where s is sinθ at the rows and linear between them; s / sinθ is 1 up to the square of the rows' spacing. p is positive wherever
// there is light. Both angles are found by inverting cumulative distributions, which are piecewise cubic over rows, and piecewise
// quadratic over the columns of the interpolated row.
#pragma once

#include "core/image/image.h"
#include "core/sampling/warp.h"

#include <memory>
#include <vector>

namespace neumann {

class EnvironmentMap {
public:
    // `image` must be finite, not negative, and at least 2×3. `to_world` must consist of rotations and reflections, up to rounding.
    EnvironmentMap(Image image, double scale, const Mat4& to_world);

    Rgb radiance(const Vec3& w) const;
    Vec3 sample(const Vec2& u) const;
    double pdf(const Vec3& w) const;
    const Rgb& largest() const { return largest_; }
    // The mean luminance; it is 0 only if there is no light.
    double brightness() const { return total_ * scale_ / (4.0 * pi); }
    bool is_grey() const { return is_grey_; }

private:
    // A position between columns x and x + 1 (the last is followed by the first) and between rows y and y + 1, with fractions.
    struct TexelPosition {
        int x, y;
        double right, down;
    };
    struct Quadratic;
    // These tables do not include the scale.
    struct Tables {
        Image image;
        // Luminance added up along each row by the trapezoidal rule, from the middle of its first pixel on: width + 1 numbers a
        // row.
        std::vector<double> along_row;
        std::vector<double> up_to_row;  // the fraction of the total above each row
        std::vector<double> sine;       // sinθ of each row

        double along(int y, int x) const;
        // The luminance added up to column x, in the row that is `down` of the way from row y to the next.
        double along(const TexelPosition& p, int x) const;
        Quadratic between_rows(int y) const;
    };
    TexelPosition place(const Vec3& local) const;
    Rgb unscaled(const TexelPosition& p) const;

    Vec3 x_, y_, z_;  // the axes of the map's space, in the world
    double scale_;
    std::shared_ptr<const Tables> tables_;
    double total_ = 0.0;  // ∫∫ Y s dθ dφ without the scale
    Rgb largest_{0.0};
    bool is_grey_ = true;
};

}  // namespace neumann
