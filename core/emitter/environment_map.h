// Light from infinitely far away by a picture of all directions (Mitsuba's `envmap`): column by longitude, row by latitude, the
// first and the last row the poles. In the map's own space +y is up, the middle of the picture looks along +z and its left quarter
// along +x. Between pixels the radiance is bilinear in the angles.
//
// Directions are drawn with a density proportional to the luminance of what they show,
//
//     p(ω) = Y(ω) s(θ) / (sinθ ∫∫ Y s dθ dφ),
//
// exactly so but for s, which is sinθ at the rows and linear between them; its quotient by sinθ is 1 but for the rows' spacing
// squared. So p is positive wherever there is light. Both angles are found by inverting cumulative distributions: of rows, by
// cubics; and of columns, by parabolas, for the row that interpolation makes of its two neighbours.
#pragma once

#include "core/image/image.h"
#include "core/sampling/warp.h"

#include <memory>
#include <vector>

namespace neumann {

class EnvironmentMap {
public:
    // `image`: finite, not negative, at least 2×3. `to_world`: rotations and reflections, to rounding.
    EnvironmentMap(Image image, double scale, const Mat4& to_world);

    Rgb radiance(const Vec3& w) const;
    Vec3 sample(const Vec2& u) const;
    double pdf(const Vec3& w) const;
    const Rgb& largest() const { return largest_; }
    // As luminance weighs the channels, so that it is 0 only where there is no light.
    double brightness() const { return total_ * scale_ / (4.0 * pi); }
    bool is_grey() const { return is_grey_; }

private:
    // Between columns x and x + 1, the first after the last, and between rows y and y + 1: parts of the way.
    struct Place {
        int x, y;
        double right, down;
    };
    struct Quadratic;
    // Without the scale.
    struct Tables {
        Image image;
        // Luminance added up along each row by the trapezoidal rule, from the middle of its first pixel on: width + 1 numbers a
        // row.
        std::vector<double> along_row;
        std::vector<double> up_to_row;  // the part of the whole that is above a row
        std::vector<double> sine;       // of the rows' θ

        double along(int y, int x) const;
        // At column x of the row that is `down` of the way from row y to the next.
        double along(const Place& p, int x) const;
        Quadratic between_rows(int y) const;
    };
    Place place(const Vec3& local) const;
    Rgb unscaled(const Place& p) const;

    Vec3 x_, y_, z_;  // the axes of the map's space, in the world
    double scale_;
    std::shared_ptr<const Tables> tables_;
    double total_ = 0.0;  // ∫∫ Y s dθ dφ without the scale
    Rgb largest_{0.0};
    bool is_grey_ = true;
};

}  // namespace neumann
