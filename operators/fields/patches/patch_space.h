// The finite-dimensional space on which T and R are matrices. Its unknowns are the exitant radiance of each side of each patch in
// each of its cells of directions. Sides that neither reflect nor emit, and sides that face nothing, have no unknowns. The values
// are basic radiance L/n², which refraction conserves; n is the refractive index of the medium that the side faces. This file knows
// geometry only; operators/fields/matrix/sides.h derives the cells and n of each side from the materials.
#pragma once

#include "core/base/frame.h"
#include "core/geometry/shading_point.h"
#include "operators/fields/patches/direction_cells.h"
#include "operators/fields/patches/patches.h"

#include <utility>

namespace neumann {

// The cells of directions of the two sides of a shape, as DirectionCells::k; 0 if the side neither reflects nor emits.
struct SideDirections {
    std::uint32_t front = 1, back = 0;
    bool emits = false;                          // the front side emits
    bool lit_from_elsewhere = false;             // lights other than surfaces exist, so sides that face no surface may be lit
    double front_index = 1.0, back_index = 1.0;  // n
    std::uint32_t of(bool front_side) const { return front_side ? front : back; }
};

// One side of a patch, with a row of unknowns.
struct Facet {
    std::uint32_t patch;
    bool front;
    DirectionCells cells;
    std::uint32_t first;  // number of its first unknown; those of the back follow those of the front
    double index = 1.0;   // n
};

class PatchSpace {
public:
    // `sides` has one entry for each shape. Throws InputError as Patches does, and if the unknowns do not fit in 32 bits.
    PatchSpace(const Geometry& geometry, const Patching& patching, std::vector<SideDirections> sides)
        : PatchSpace(Patches(geometry, patching), std::move(sides)) {}

    // The space on Patches::coarser(), with cells of directions twice as wide.
    PatchSpace coarser() const;
    // For each unknown, the coarser unknown that contains it.
    std::vector<std::uint32_t> coarser_of_each(const PatchSpace& coarser) const;

    const Geometry& geometry() const { return patches_.geometry(); }
    const Patches& patches() const { return patches_; }
    const std::vector<Facet>& facets() const { return facets_; }
    std::uint32_t size() const { return size_; }
    // The number that stands for no unknown, one past the last unknown; its radiance is zero.
    std::uint32_t nothing() const { return size_; }

    // The étendue of each unknown, n² times area times projected solid angle: ⟨f, g⟩ = Σ measure f g, and Σ measure f
    // is the power of a basic radiance f.
    double measure(const Facet& facet) const {
        return facet.index * facet.index * patches_.area(facet.patch) * pi / facet.cells.size();
    }

    // The facet of an unknown.
    std::uint32_t facet_of(std::uint32_t unknown) const { return facet_of_unknown_[unknown]; }
    // The first unknown of a facet; size() if `facet` is facets().size().
    std::uint32_t first_unknown(std::uint32_t facet) const { return facet < facets_.size() ? facets_[facet].first : size_; }
    // The facet of a side of a patch, or facets().size() if it has none.
    std::uint32_t facet(std::uint32_t patch, bool front) const { return facet_of_side_[side(patch, front)]; }

    // Whether the direction w lies on the front side of p: by the shading normal, as in R at a point, but for shapes
    // that emit by the geometric normal, as in Le.
    bool is_front(const SurfacePoint& p, const Vec3& w) const {
        const bool by_shading = is_smooth_[p.shape] && !sides_[p.shape].emits;
        return glm::dot(by_shading ? shading_normal(geometry().shapes()[p.shape], p) : p.normal, w) > 0.0;
    }
    // The unknown of the radiance that leaves p along w.
    std::uint32_t unknown(const SurfacePoint& p, const Vec3& w) const {
        const bool front = is_front(p, w);
        if (sides_[p.shape].of(front) == 0) return nothing();
        return unknown(patches_.locate(p), front, p, w);
    }
    // A frame whose z points away from the facet's side along the shading normal, as in R at a point.
    Frame frame(const Facet& facet, const SurfacePoint& p) const { return frame(facet.front, p); }
    // Whether the normal of frame() may vary over a plane patch.
    bool is_smooth(const Facet& facet) const { return is_smooth_[patches_.chart(facet.patch).shape()]; }

    // The radiance that leaves p along w, interpolated linearly between patches: Σ weight · field[unknown]. The weight is 0 if
    // there is no unknown.
    struct Reading {
        std::array<std::uint32_t, 4> unknown;
        std::array<double, 4> weight;
    };
    Reading read(const SurfacePoint& p, const Vec3& w) const { return read(p, patches_.place(p), w); }
    Reading read(const SurfacePoint& p, const Patches::ChartPosition& place, const Vec3& w) const;

private:
    PatchSpace(Patches patches, std::vector<SideDirections> sides);
    Frame frame(bool front, const SurfacePoint& p) const {
        const Vec3 n = shading_normal(geometry().shapes()[p.shape], p);
        return Frame(front ? n : -n);
    }
    std::uint32_t unknown(std::uint32_t patch, bool front, const SurfacePoint& p, const Vec3& w) const {
        const std::uint32_t first = first_of_side_[side(patch, front)];
        const DirectionCells cells{sides_[p.shape].of(front)};
        return cells.k == 1 || first == nothing() ? first : first + cells.cell(frame(front, p).to_local(w));
    }
    static std::size_t side(std::uint32_t patch, bool front) { return 2 * std::size_t{patch} + (front ? 0 : 1); }

    Patches patches_;
    std::vector<SideDirections> sides_;
    std::vector<bool> is_smooth_;  // for each shape
    std::vector<Facet> facets_;
    std::vector<std::uint32_t> facet_of_unknown_;
    std::vector<std::uint32_t> facet_of_side_, first_of_side_;  // front and back of each patch; first unknown, or nothing()
    std::uint32_t size_ = 0;
};

}  // namespace neumann
