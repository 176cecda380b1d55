// Where indirect light comes from: incident radiance sampling (Dutré, Bekaert and Bala, Advanced Global Illumination, 8.6.2), with
// the fields on patches in place of photons. For each facet and number of bounces that a walk is still for, a density of the next
// direction over a grid of cells, a mixture of the cosine's and of what the facet's rays see:
//
//     pdf(ω) = cosθ/π (α + (1 − α) w / mean w),     w² = Σ_k (K^k Le)² / m_k,   k = 1 … bounces that are still wanted
//
// m_k is the mean of K^k Le over the scene. For one bounce alone the best density is proportional to K^k Le; for a sum of variances
// it is the root of the sum of squares, of which 1/m_k is between the errors relative to each bounce (1/m_k²) and the absolute ones
// (1). Le is not among them, because walks find it by light sampling. Any density above 0 leaves walks unbiased.
#pragma once

#include "core/base/memory.h"
#include "core/scene/scene.h"
#include "operators/guide/cell_distribution.h"
#include "operators/guide/facet_raster.h"
#include "operators/patches/patch_space.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace neumann {

struct GuideSettings {
    std::size_t patches = 2000;        // about as many
    std::uint32_t rays = 2048;         // of a facet, that tell what it sees; a power of two, of at least CellDistribution::cells
    std::uint32_t field_rays = 64;     // of a facet, for the fields; a power of two
    double share_of_material = 0.4;    // α, above 0
    int bounces = 8;                   // N: the last that is wanted
    std::uint64_t seed = 0;            // the tables use other random numbers than walks of the same seed
    double memory = default_memory();  // bytes that may be taken, about
};

class DirectionTables {
public:
    // Tables for 1, 2, … bounces that are still wanted; the last is for more, too.
    static constexpr int most_tables = 2;

    // The scene is kept by reference. Throws InputError as scene_patches() does, and where more is asked for than
    // memory holds.
    DirectionTables(const Scene& scene, const GuideSettings& settings);

    // For the side of p on which `wo` is; `wanted` ≥ 1: bounces after the one that is sampled. Directions are in Frame(normal) of
    // the normal on that side. Null where nothing is known.
    const CellDistribution* at(const SurfacePoint& p, const Vec3& wo, int wanted) const {
        const std::uint32_t facet = raster_.facet(p, glm::dot(p.normal, wo) > 0.0);
        if (facet == space_.facets().size()) return nullptr;
        const int table = std::min(wanted, static_cast<int>(tables_of_facet_)) - 1;
        return &tables_[facet * tables_of_facet_ + static_cast<std::size_t>(table)];
    }

    const PatchSpace& space() const { return space_; }
    const GuideSettings& settings() const { return settings_; }
    std::uint64_t rays() const { return rays_; }

private:
    GuideSettings settings_;
    PatchSpace space_;
    FacetRaster raster_;
    std::size_t tables_of_facet_;
    std::vector<CellDistribution> tables_;
    std::uint64_t rays_ = 0;
};

}  // namespace neumann
