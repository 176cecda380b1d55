// The assignment of materials to the sides of shapes. A side without a material absorbs all light.
#pragma once

#include "core/material/bsdf.h"

#include <memory>
#include <vector>

namespace neumann {

// One side of a surface at a point: its material and its shading point. Directions are in the frame of `p`, whose z points to this
// side.
struct SurfaceSide {
    const Bsdf* bsdf;  // null if the side absorbs
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

    // The side of the surface at p on which the direction w, which points away from p, lies.
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
    // Whether the shape's materials need the geometric normal only.
    bool is_flat(std::uint32_t shape) const { return is_flat_[shape] != 0; }
    // The material on one side of a shape, or null if that side absorbs.
    const Bsdf* at(std::uint32_t shape, bool front) const {
        const Sides& sides = sides_of_shape_[shape];
        const int index = front ? sides.front : sides.back;
        return index == absorbing ? nullptr : &bsdfs_[static_cast<std::size_t>(index)];
    }
    // The largest albedo of any material on a shape, for each channel: an upper bound on ‖R‖ in every L^p (Riesz–Thorin, with
    // reciprocity), but only in L^∞ if shading normals differ from geometric ones.
    Rgb largest_albedo() const;
    // The same for basic radiance L/n², for which glass has at most 1.
    Rgb largest_basic_albedo() const;

    const std::vector<Bsdf>& bsdfs() const { return bsdfs_; }

private:
    std::vector<Bsdf> bsdfs_;
    std::vector<Sides> sides_of_shape_;
    std::shared_ptr<const std::vector<Shape>> shapes_;
    std::vector<char> is_flat_;  // by shape
};

// Whether some material has a delta lobe.
bool has_specular(const Materials& materials);

}  // namespace neumann
