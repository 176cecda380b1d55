// What the errors of pictures from fields are made of, learnt from render to render: what other settings would bring them to, and
// which settings an error needs.
//
//     error² = A / samples + B / rays + C / max(rays, cells) + (D patches^-order)²
//
// A: camera samples; B and C: rays of T, C of sides with `cells` cells of directions, each of which has a ray at least; D: patches.
#pragma once

#include "operators/pictures/field_pictures.h"

#include <optional>
#include <vector>

namespace neumann {

struct WorstError {
    double error = 0.0;  // relative, of the whole picture
    std::size_t bounce = 0;
};

class FieldErrors {
public:
    // `most`: the largest settings that are gone to.
    FieldErrors(const FieldSettings& most) : most_(most) {}

    // Errors of every term, of a render with these settings whose finest sides have so many cells of directions. The second differs
    // from the first in the number of samples alone.
    void add(const FieldSettings& settings, std::uint32_t finest, std::vector<PictureError> errors);

    WorstError worst() const { return worst_of(errors_); }
    WorstError predict(const FieldSettings& settings) const;
    // The error of patches of this term does not fall any more: what is left is that of cells of directions, which get no finer.
    bool stands(std::size_t bounce) const { return finest_ > 1 && order_of(bounce) < least_order; }

    // The last settings with more of what makes the errors, up to this factor for each part.
    FieldSettings grow(double target, double most_growth) const;

private:
    static constexpr double least_order = 0.125;
    static WorstError worst_of(const std::vector<PictureError>& errors);
    double order_of(std::size_t i) const;
    double part_of_cells(std::size_t i) const { return by_cells_.empty() ? 0.0 : by_cells_[i]; }

    FieldSettings most_, last_;
    std::uint32_t finest_ = 1;
    std::size_t renders_ = 0;
    std::vector<PictureError> errors_;
    std::vector<double> by_samples_;  // A
    std::vector<double> by_cells_;    // C's part of what is not A's; 0 until rays have grown
    // Before patches grew last.
    std::vector<PictureError> errors_before_;
    std::size_t patches_before_ = 0;
};

}  // namespace neumann
