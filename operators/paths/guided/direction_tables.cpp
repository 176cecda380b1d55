#include "operators/paths/guided/direction_tables.h"

#include "core/base/frame.h"
#include "core/base/hot.h"
#include "operators/fields/matrix/facet_rays.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <map>
#include <numeric>

namespace neumann {

namespace {

// With fewer rays than this, a table is smoothed: a cell whose few rays happen to see little is not dark.
constexpr std::uint32_t rays_of_sharp_table = 4 * CellDistribution::cells;

// The random numbers are independent of those of walks with the same seed, and of those of the fields.
constexpr std::uint64_t table_stream = 0x67756964652074ull;

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

// The mean of each cell and its neighbours.
CellDistribution::Weights smooth(const CellDistribution::Weights& seen) {
    constexpr auto k = static_cast<int>(CellDistribution::k);
    CellDistribution::Weights means;
    for (int row = 0; row < k; ++row)
        for (int column = 0; column < k; ++column) {
            double sum = 0.0, count = 0.0;
            for (int j = std::max(row - 1, 0); j <= std::min(row + 1, k - 1); ++j)
                for (int i = std::max(column - 1, 0); i <= std::min(column + 1, k - 1); ++i, count += 1.0)
                    sum += seen[static_cast<std::size_t>(j * k + i)];
            means[static_cast<std::size_t>(row * k + column)] = sum / count;
        }
    return means;
}

// Fills the tables of one facet.
NEUMANN_HOT void look_around(const PatchSpace& space, const SobolPoints& sobol, std::uint64_t seed, std::uint32_t facet,
                             const Attraction& attraction, double share_of_material, std::span<CellDistribution> tables) {
    std::array<CellDistribution::Weights, DirectionTables::most_tables> seen{};
    // Rough rays are enough, because they only affect how often directions are sampled.
    for_rays_of_facet(space, sobol, seed, facet, {.of_a_point = 4, .rough = true}, [&](const Vec2& u, const Sight& sight) {
        const std::uint32_t cell = CellDistribution::grid.cell_of_square(u);
        for (std::size_t t = 0; t < tables.size(); ++t) seen[t][cell] += attraction[sight.unknown][t];
    });
    for (std::size_t t = 0; t < tables.size(); ++t)
        tables[t] = mixture(sobol.size() < rays_of_sharp_table ? smooth(seen[t]) : seen[t], share_of_material);
}

}  // namespace

DirectionTables::DirectionTables(const FieldStack& fields, const TableSettings& settings, const Watch& watch)
    : space_(&fields.space()), raster_(*space_) {
    const int n = terms(settings.bounces);
    tables_of_facet_ = static_cast<std::size_t>(std::min(n, most_tables));
    const auto facets = static_cast<std::uint32_t>(space_->facets().size());
    tables_.resize(facets * tables_of_facet_);
    const Attraction attraction(fields, n, tables_of_facet_);
    const SobolPoints sobol(settings.rays);
    oneapi::tbb::parallel_for(std::uint32_t{0}, facets, [&](std::uint32_t facet) {
        if (watch.stop()) return;
        look_around(*space_, sobol, settings.seed ^ table_stream, facet, attraction, settings.share_of_material,
                    std::span(tables_).subspan(facet * tables_of_facet_, tables_of_facet_));
    });
    if (watch.stop()) throw Stopped();
    rays_ = std::uint64_t{settings.rays} * facets;
}

DirectionTables DirectionTables::with(std::span<const Arrival> arrivals, double share) const {
    constexpr double few = 4.0;
    struct Arrived {
        double count = 0.0;
        CellDistribution::Weights power{};
    };
    std::map<std::uint32_t, Arrived> of_facet;
    for (const Arrival& arrival : arrivals) {
        const bool front = glm::dot(arrival.at.normal, arrival.w) > 0.0;
        const std::uint32_t facet = raster_.facet(arrival.at, front);
        if (facet == space_->facets().size()) continue;
        const Vec3 local = Frame(front ? arrival.at.normal : -arrival.at.normal).to_local(arrival.w);
        Arrived& arrived = of_facet[facet];
        arrived.count += 1.0;
        arrived.power[CellDistribution::grid.cell(local)] += arrival.power;
    }
    DirectionTables result = *this;
    for (const auto& [facet, arrived] : of_facet) {
        const double all = std::accumulate(arrived.power.begin(), arrived.power.end(), 0.0);
        if (!(all > 0.0)) continue;
        const double to_them = share * arrived.count / (arrived.count + few);
        for (std::size_t t = 0; t < tables_of_facet_; ++t) {
            CellDistribution& table = result.tables_[facet * tables_of_facet_ + t];
            CellDistribution::Weights weights;
            for (std::uint32_t cell = 0; cell < CellDistribution::cells; ++cell)
                weights[cell] =
                    (1.0 - to_them) * table.density(cell) / CellDistribution::cells + to_them * arrived.power[cell] / all;
            table = CellDistribution(weights);
        }
    }
    return result;
}

}  // namespace neumann
