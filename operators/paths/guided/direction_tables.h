// Tables for path guiding: incident radiance sampling (Dutré, Bekaert and Bala, Advanced Global Illumination, 8.6.2), with fields
// on patches in place of photons. For each facet and each number of bounces still wanted there is a density of the next direction
// on a grid of cells, a mixture of the cosine density and a density in proportion to what the facet's rays see:
//
//     pdf(ω) = cosθ/π (α + (1 − α) w / mean w),     w² = Σ_k (K^k Le)² / m_k,   k = 1 … number of bounces still wanted
//
// m_k is the mean of K^k Le over the scene. The best density for a single bounce is proportional to K^k Le; for a sum of variances
// it is the root of the sum of squares. The factor 1/m_k is a compromise between relative errors of each bounce (1/m_k²) and
// absolute errors (1). Le is left out, because walks find it by light sampling. Any density above 0 leaves walks unbiased.
#pragma once

#include "operators/fields/matrix/field_stack.h"
#include "operators/paths/guided/cell_distribution.h"
#include "operators/paths/guided/facet_raster.h"
#include "operators/watch.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace neumann {

struct TableSettings {
    std::uint32_t rays = 2048;       // per facet, to fill its tables; a power of two, at least CellDistribution::cells
    double share_of_material = 0.4;  // α, above 0
    int bounces = 8;                 // N: the last bounce wanted
    std::uint64_t seed = 0;          // the tables' random numbers are independent of those of walks with the same seed
};

class DirectionTables {
public:
    // There are tables for 1, 2, … bounces still wanted; the last one is also used for more.
    static constexpr int most_tables = 2;
    // The number of terms of the series that are used; later ones are nearly isotropic.
    static constexpr int most_terms = 16;
    static int terms(int bounces) { return std::clamp(bounces - 1, 1, most_terms); }

    // `fields` has at least terms(settings.bounces) bounces. Keeps a reference to their space. Throws Stopped if `watch` stops it.
    DirectionTables(const FieldStack& fields, const TableSettings& settings, const Watch& watch = {});
    // The size of the tables of a facet in bytes.
    static constexpr std::size_t bytes_of_facet = most_tables * sizeof(CellDistribution);

    // The table for the side of p on which `wo` is; null if there is none. `wanted` ≥ 1 is the number of bounces after
    // the one that is sampled. Directions are in Frame(normal), with the normal of that side.
    const CellDistribution* at(const SurfacePoint& p, const Vec3& wo, int wanted) const {
        const std::uint32_t facet = raster_.facet(p, glm::dot(p.normal, wo) > 0.0);
        if (facet == space_->facets().size()) return nullptr;
        const int table = std::min(wanted, static_cast<int>(tables_of_facet_)) - 1;
        return &tables_[facet * tables_of_facet_ + static_cast<std::size_t>(table)];
    }

    // The same tables, but of the directions from a facet up to this share are towards light that arrived there, in proportion to
    // its power.
    struct Arrival {
        SurfacePoint at;
        Vec3 w;  // towards where it came from
        double power;
    };
    DirectionTables with(std::span<const Arrival> arrivals, double share) const;

    std::uint64_t rays() const { return rays_; }

private:
    const PatchSpace* space_;
    FacetRaster raster_;
    std::size_t tables_of_facet_;
    std::vector<CellDistribution> tables_;
    std::uint64_t rays_ = 0;
};

}  // namespace neumann
