#include "operators/fields/patches/patch_space.h"

#include "core/base/error.h"
#include "operators/fields/patches/facing.h"

#include <fmt/format.h>
#include <algorithm>
#include <limits>

namespace neumann {

PatchSpace::PatchSpace(Patches patches, std::vector<SideDirections> sides)
    : patches_(std::move(patches)), sides_(std::move(sides)), facet_of_side_(2 * patches_.size()) {
    for (const Shape& shape : geometry().shapes()) is_smooth_.push_back(has_smooth_normals(shape));
    const Facing facing(geometry());
    std::uint64_t unknowns = 0;
    const Chart* chart = nullptr;
    SideDirections directions;
    for (std::uint32_t patch = 0; patch < patches_.size(); ++patch) {
        if (chart != &patches_.chart(patch)) {
            chart = &patches_.chart(patch);
            directions = sides_[chart->shape()];
            if (!directions.lit_from_elsewhere) {
                if (!directions.emits && facing.nothing(*chart, true)) directions.front = 0;
                if (facing.nothing(*chart, false)) directions.back = 0;
            }
        }
        for (const bool front : {true, false}) {
            const std::uint32_t k = directions.of(front);
            if (k == 0) continue;
            facets_.push_back(
                {patch, front, {k}, static_cast<std::uint32_t>(unknowns), front ? directions.front_index : directions.back_index});
            unknowns += DirectionCells{k}.size();
        }
    }
    if (unknowns >= std::numeric_limits<std::uint32_t>::max())
        throw InputError(
            fmt::format("{} patches have {} unknowns, more than can be numbered; take fewer patches", patches_.size(), unknowns));
    size_ = static_cast<std::uint32_t>(unknowns);
    facet_of_unknown_.reserve(size_);
    for (std::uint32_t f = 0; f < facets_.size(); ++f)
        facet_of_unknown_.insert(facet_of_unknown_.end(), facets_[f].cells.size(), f);
    std::fill(facet_of_side_.begin(), facet_of_side_.end(), static_cast<std::uint32_t>(facets_.size()));
    first_of_side_.assign(facet_of_side_.size(), nothing());
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
        const std::size_t of = side(facets_[f].patch, facets_[f].front);
        facet_of_side_[of] = f;
        first_of_side_[of] = facets_[f].first;
    }
}

PatchSpace::Reading PatchSpace::read(const SurfacePoint& p, const Patches::ChartPosition& place, const Vec3& w) const {
    const bool front = is_front(p, w);
    Reading reading{{nothing(), nothing(), nothing(), nothing()}, {}};
    if (sides_[p.shape].of(front) == 0) return reading;
    const Patches::Reading patches = patches_.interpolate(place);
    for (std::size_t i = 0; i < 4; ++i) {
        reading.unknown[i] = unknown(patches.patch[i], front, p, w);
        if (reading.unknown[i] == nothing()) return reading;
        reading.weight[i] = patches.weight[i];
    }
    return reading;
}

PatchSpace PatchSpace::coarser() const {
    std::vector<SideDirections> sides = sides_;
    for (SideDirections& side : sides)
        for (std::uint32_t* k : {&side.front, &side.back})
            if (*k > 0) *k = DirectionCells{*k}.coarser().k;
    return PatchSpace(patches_.coarser(), std::move(sides));
}

std::vector<std::uint32_t> PatchSpace::coarser_of_each(const PatchSpace& coarser) const {
    const std::vector<std::uint32_t> patch = patches_.coarser_of_each(coarser.patches_);
    std::vector<std::uint32_t> result(size_);
    for (const Facet& facet : facets_) {
        const Facet& around = coarser.facets_[coarser.facet(patch[facet.patch], facet.front)];
        for (std::uint32_t cell = 0; cell < facet.cells.size(); ++cell)
            result[facet.first + cell] = around.first + facet.cells.coarser(cell);
    }
    return result;
}

}  // namespace neumann
