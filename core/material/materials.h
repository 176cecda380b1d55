// Which material stands on which side of which shape. A side without a material absorbs what arrives.
#pragma once

#include "core/material/bsdf.h"

#include <vector>

namespace neumann {

class Materials {
public:
    static constexpr int absorbing = -1;
    // Indices into the list of materials, or `absorbing`. Mitsuba's `twosided` fills both.
    struct Sides {
        int front = absorbing;
        int back = absorbing;
    };

    Materials(std::vector<Bsdf> bsdfs, std::vector<Sides> sides_of_shape)
        : bsdfs_(std::move(bsdfs)), sides_of_shape_(std::move(sides_of_shape)) {}

    // The material on one side of the surface at p, or null where that side absorbs.
    const Bsdf* at(const SurfacePoint& p, bool front) const {
        const Sides& sides = sides_of_shape_[p.shape];
        const int index = front ? sides.front : sides.back;
        return index == absorbing ? nullptr : &bsdfs_[static_cast<std::size_t>(index)];
    }
    // The largest albedo of any material that stands on a shape, for each channel: an upper bound on ‖R‖ in every L^p
    // (Riesz–Thorin, with reciprocity).
    Rgb largest_albedo() const;

    const std::vector<Bsdf>& bsdfs() const { return bsdfs_; }

private:
    std::vector<Bsdf> bsdfs_;
    std::vector<Sides> sides_of_shape_;
};

}  // namespace neumann
