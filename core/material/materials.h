// Which material stands on which side of which shape. A side without a material absorbs what arrives.
#pragma once

#include "core/material/bsdf.h"

#include <memory>
#include <vector>

namespace neumann {

// The side of a surface that is looked at: what it is made of, and where. Directions are in the frame of `p`, whose z points to
// this side.
struct SurfaceSide {
    const Bsdf* bsdf;  // null where it absorbs
    ShadingPoint p;
};

class Materials {
public:
    static constexpr int absorbing = -1;
    // Indices into the list of materials, or `absorbing`. Mitsuba's `twosided` fills both.
    struct Sides {
        int front = absorbing;
        int back = absorbing;
    };

    Materials(std::vector<Bsdf> bsdfs, std::vector<Sides> sides_of_shape, std::shared_ptr<const std::vector<Shape>> shapes);

    // What a direction w, away from p, is on the side of.
    SurfaceSide side(const SurfacePoint& p, const Vec3& w) const {
        if (is_flat_[p.shape]) {
            const bool front = glm::dot(p.normal, w) > 0.0;
            return {at(p.shape, front), {p, nullptr, Frame(front ? p.normal : -p.normal)}};
        }
        SurfaceSide side{nullptr, shading_point((*shapes_)[p.shape], p)};
        const bool front = glm::dot(side.p.frame.n, w) > 0.0;
        if (!front) side.p.frame = side.p.frame.other_side();
        side.bsdf = at(p.shape, front);
        return side;
    }
    // The material on one side of a shape, or null where that side absorbs.
    const Bsdf* at(std::uint32_t shape, bool front) const {
        const Sides& sides = sides_of_shape_[shape];
        const int index = front ? sides.front : sides.back;
        return index == absorbing ? nullptr : &bsdfs_[static_cast<std::size_t>(index)];
    }
    // The largest albedo of any material that stands on a shape, for each channel: an upper bound on ‖R‖ in every L^p
    // (Riesz–Thorin, with reciprocity), and in L^∞ alone where shading normals differ from geometric ones.
    Rgb largest_albedo() const;
    // The same of basic radiance L/n², for which glass has no more than 1.
    Rgb largest_basic_albedo() const;

    const std::vector<Bsdf>& bsdfs() const { return bsdfs_; }

private:
    std::vector<Bsdf> bsdfs_;
    std::vector<Sides> sides_of_shape_;
    std::shared_ptr<const std::vector<Shape>> shapes_;
    std::vector<char> is_flat_;  // by shape: nothing there needs more than the geometric normal
};

}  // namespace neumann
