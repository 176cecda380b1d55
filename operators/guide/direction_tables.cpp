#include "operators/guide/direction_tables.h"

#include "core/base/hot.h"
#include "operators/matrix/facet_rays.h"
#include "operators/matrix/scene_patches.h"
#include "operators/matrix/traced_series.h"
#include "operators/patches/patch_memory.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>

namespace neumann {

namespace {

// Independent of the random numbers of walks with the same seed, and of each other.
constexpr std::uint64_t field_stream = 0x6775696465206bull, table_stream = 0x67756964652074ull;

// Number of terms of the series used; later ones are nearly isotropic.
constexpr int most_terms = 16;

// Checks the memory for the fields (also on coarser patches), work space, T and the tables. Called before the patch space exists,
// and again when the number of unknowns is known.
void check_memory(const GuideSettings& settings, double unknowns, double facets) {
    check_patch_memory(settings.patches, settings.rays,
                       300.0 + unknowns * (32.0 + 15.0 * (most_terms + 2.0) + 4.0 * DirectionTables::most_tables) +
                           facets * (4.0 * settings.field_rays + DirectionTables::most_tables * sizeof(CellDistribution)),
                       settings.memory);
}

PatchSpace make_space(const Scene& scene, const GuideSettings& settings) {
    check_memory(settings, 1.0, 1.0);
    PatchSpace space = scene_patches(scene, {.patches = settings.patches});
    const auto patches = static_cast<double>(space.patches().size());
    check_memory(settings, space.size() / patches, static_cast<double>(space.facets().size()) / patches);
    return space;
}

// w of each unknown, for each number of bounces still wanted. The last entries are for PatchSpace::nothing() and are 0.
class Attraction {
public:
    Attraction(const FieldStack& field, int terms, std::size_t tables)
        : tables_(tables), values_(tables * (field.space().size() + 1)) {
        const PatchSpace& space = field.space();
        const auto value = [&](std::uint32_t unknown, int k) {
            const float* v = field[unknown] + 3 * k;
            return double{v[0]} + v[1] + v[2];
        };
        std::vector<double> mean(static_cast<std::size_t>(terms) + 1);
        for (const Facet& facet : space.facets())
            for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u)
                for (int k = 1; k <= terms; ++k) mean[static_cast<std::size_t>(k)] += space.measure(facet) * value(u, k);
        for (std::uint32_t u = 0; u < space.size(); ++u) {
            double sum = 0.0;
            for (int k = 1; k <= terms; ++k) {
                const double m = mean[static_cast<std::size_t>(k)];
                if (m > 0.0) sum += value(u, k) * (value(u, k) / m);
                const std::size_t table = std::min(static_cast<std::size_t>(k), tables) - 1;
                values_[u * tables_ + table] = static_cast<float>(std::sqrt(sum));
            }
        }
    }
    const float* operator[](std::uint32_t unknown) const { return values_.data() + unknown * tables_; }

private:
    std::size_t tables_;
    std::vector<float> values_;
};

CellDistribution mixture(const CellDistribution::Weights& seen, double share_of_material) {
    const double sum = std::accumulate(seen.begin(), seen.end(), 0.0);
    if (!(sum > 0.0)) return {};
    CellDistribution::Weights weights;
    for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] = share_of_material / CellDistribution::cells + (1.0 - share_of_material) * (seen[i] / sum);
    return CellDistribution(weights);
}

// Fills the tables of one facet.
NEUMANN_HOT void look_around(const PatchSpace& space, const SobolPoints& sobol, std::uint64_t seed, std::uint32_t facet,
                             const Attraction& attraction, double share_of_material, std::span<CellDistribution> tables) {
    std::array<CellDistribution::Weights, DirectionTables::most_tables> seen{};
    for_rays_of_facet(space, sobol, seed, facet, [&](const Vec2& u, std::uint32_t unknown) {
        const std::uint32_t cell = CellDistribution::grid.cell_of_square(u);
        for (std::size_t t = 0; t < tables.size(); ++t) seen[t][cell] += attraction[unknown][t];
    });
    for (std::size_t t = 0; t < tables.size(); ++t) tables[t] = mixture(seen[t], share_of_material);
}

}  // namespace

DirectionTables::DirectionTables(const Scene& scene, const GuideSettings& settings)
    : settings_(settings), space_(make_space(scene, settings)), raster_(space_) {
    const int terms = std::clamp(settings.bounces - 1, 1, most_terms);
    tables_of_facet_ = static_cast<std::size_t>(std::min(terms, most_tables));
    const auto facets = static_cast<std::uint32_t>(space_.facets().size());
    tables_.resize(facets * tables_of_facet_);
    const TracedSeries series =
        trace_series(scene, space_, space_.coarser(),
                     {.bounces = terms, .rays = settings.field_rays, .seed = settings.seed ^ field_stream, .rest = false});
    const Attraction attraction(series.fine, terms, tables_of_facet_);
    const SobolPoints sobol(settings.rays);
    oneapi::tbb::parallel_for(std::uint32_t{0}, facets, [&](std::uint32_t facet) {
        look_around(space_, sobol, settings.seed ^ table_stream, facet, attraction, settings.share_of_material,
                    std::span(tables_).subspan(facet * tables_of_facet_, tables_of_facet_));
    });
    rays_ = series.rays + std::uint64_t{settings.rays} * facets;
}

}  // namespace neumann
