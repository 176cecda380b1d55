// The space that T and R become matrices on. Its unknowns are the exitant radiance of each side of each patch in each cell of its
// directions; a side that neither reflects nor emits has none, nor has one that faces nothing. It is basic radiance L/n², which
// glass does not change, with the refractive index n of the medium that the side faces. Geometry only: how many directions a side
// needs, and n, is told by whoever knows the materials (operators/matrix/sides.h).
#pragma once

#include "core/base/frame.h"
#include "operators/patches/direction_cells.h"
#include "operators/patches/patches.h"

#include <utility>

namespace neumann {

// Directions of the two sides of a shape, as DirectionCells::k; 0: this side is neither seen nor lit.
struct SideDirections {
    std::uint32_t front = 1, back = 0;
    bool emits = false;                          // the front does
    bool lit_from_elsewhere = false;             // by more than surfaces: what faces no surface may be lit
    double front_index = 1.0, back_index = 1.0;  // n
    std::uint32_t of(bool front_side) const { return front_side ? front : back; }
};

// One side of a patch, with a row of unknowns.
struct Facet {
    std::uint32_t patch;
    bool front;
    DirectionCells cells;
    std::uint32_t first;  // of its unknowns; those of the back follow those of the front
    double index = 1.0;   // n
};

class PatchSpace {
public:
    // `sides`: for each shape. Throws InputError as Patches does, and where there would be more unknowns than can be numbered.
    PatchSpace(const Geometry& geometry, const Patching& patching, std::vector<SideDirections> sides)
        : PatchSpace(Patches(geometry, patching), std::move(sides)) {}

    // On Patches::coarser(), with cells of directions twice as wide.
    PatchSpace coarser() const;
    // The coarser unknown around each unknown.
    std::vector<std::uint32_t> coarser_of_each(const PatchSpace& coarser) const;

    const Geometry& geometry() const { return patches_.geometry(); }
    const Patches& patches() const { return patches_; }
    const std::vector<Facet>& facets() const { return facets_; }
    std::uint32_t size() const { return size_; }
    // What is seen where there is no unknown: its radiance is zero. One past the last unknown.
    std::uint32_t nothing() const { return size_; }

    // Étendue of each unknown, n² times area times projected solid angle: ⟨f, g⟩ = Σ measure f g, and of basic radiance Σ measure f
    // is power.
    double measure(const Facet& facet) const {
        return facet.index * facet.index * patches_.area(facet.patch) * pi / facet.cells.size();
    }

    // The facet of an unknown.
    std::uint32_t facet_of(std::uint32_t unknown) const { return facet_of_unknown_[unknown]; }
    // The facet of a side of a patch; facets().size() where there is none.
    std::uint32_t facet(std::uint32_t patch, bool front) const { return facet_of_side_[side(patch, front)]; }

    // The unknown that holds what leaves p along w.
    std::uint32_t unknown(const SurfacePoint& p, const Vec3& w) const {
        const bool front = glm::dot(p.normal, w) > 0.0;
        if (sides_[p.shape].of(front) == 0) return nothing();
        return unknown(patches_.locate(p), front, p, w);
    }
    // z points away from the facet's side.
    static Frame frame(const Facet& facet, const SurfacePoint& p) { return frame(facet.front, p); }

    // What leaves p along w, of a field that is linear between the patches of a surface: Σ weight · field[unknown]. A weight is 0
    // where there is no unknown.
    struct Reading {
        std::array<std::uint32_t, 4> unknown;
        std::array<double, 4> weight;
    };
    Reading read(const SurfacePoint& p, const Vec3& w) const { return read(p, patches_.place(p), w); }
    Reading read(const SurfacePoint& p, const Patches::Place& place, const Vec3& w) const;

private:
    PatchSpace(Patches patches, std::vector<SideDirections> sides);
    static Frame frame(bool front, const SurfacePoint& p) { return Frame(front ? p.normal : -p.normal); }
    std::uint32_t unknown(std::uint32_t patch, bool front, const SurfacePoint& p, const Vec3& w) const {
        const std::uint32_t first = first_of_side_[side(patch, front)];
        const DirectionCells cells{sides_[p.shape].of(front)};
        return cells.k == 1 || first == nothing() ? first : first + cells.cell(frame(front, p).to_local(w));
    }
    static std::size_t side(std::uint32_t patch, bool front) { return 2 * std::size_t{patch} + (front ? 0 : 1); }

    Patches patches_;
    std::vector<SideDirections> sides_;
    std::vector<Facet> facets_;
    std::vector<std::uint32_t> facet_of_unknown_;
    std::vector<std::uint32_t> facet_of_side_, first_of_side_;  // front and back of each patch; first: unknown, or nothing()
    std::uint32_t size_ = 0;
};

}  // namespace neumann
