// A model of the errors of pictures from fields, fitted render by render. It predicts the errors of other settings, and
// the settings that reach a given error.
//
//     error² = A / samples + B / rays + C / max(rays, cells) + (D patches^-order)²
//
// A is for camera samples, B and C for rays of T, D for patches. C belongs to sides with `cells` cells of directions,
// which have at least one ray per cell.
#pragma once

#include "operators/render/from_fields/field_pictures.h"

#include <optional>
#include <vector>

namespace neumann {

struct WorstError {
    double error = 0.0;  // relative, of the whole picture
    std::size_t bounce = 0;
};

class FieldErrors {
public:
    // `most`: upper limits on the settings.
    FieldErrors(const FieldSettings& most) : most_(most) {}

    // Learns from the errors of every term of a render with these settings, whose finest sides have `finest` cells of
    // directions. The second render must differ from the first in the number of samples alone.
    void add(const FieldSettings& settings, std::uint32_t finest, std::vector<PictureError> errors);

    WorstError worst() const { return worst_of(errors_); }
    WorstError predict(const FieldSettings& settings) const;
    // Whether the discretisation error of this term no longer falls with more patches: it then comes from the cells of
    // directions, which are not refined.
    bool stands(std::size_t bounce) const { return finest_ > 1 && order_of(bounce) < least_order; }

    // The last settings with more samples, rays or patches to reach `target`, each multiplied by at most `most_growth`.
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
    std::vector<double> by_cells_;    // the part of C in the sampling variance without A's; 0 until rays have grown
    // These belong to the render before the number of patches last grew.
    std::vector<PictureError> errors_before_;
    std::size_t patches_before_ = 0;
};

}  // namespace neumann
