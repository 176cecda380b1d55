// A density on the unit square, constant in each of k × k cells. u.y chooses the row and u.x the cell in the row, so stratified
// numbers give stratified points. Probabilities are multiples of 2^-16: they add up to 1 exactly, and a uniform density is exactly
// uniform.
#pragma once

#include "operators/fields/patches/direction_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace neumann {

class CellDistribution {
public:
    static constexpr std::uint32_t k = 16, cells = k * k;
    static constexpr DirectionCells grid{k};
    using Weights = std::array<double, cells>;

    // The uniform distribution.
    CellDistribution() : CellDistribution(uniform()) {}
    // `weights` are in the order of DirectionCells. They should not differ by more than a factor of some hundred,
    // because probabilities below 2^-16 are rounded to 0.
    explicit CellDistribution(const Weights& weights) {
        std::array<double, k> rows;
        for (std::uint32_t row = 0; row < k; ++row) {
            const auto first = weights.begin() + row * k;
            rows[row] = std::accumulate(first, first + k, 0.0);
            cells_[row] = starts(first);
        }
        rows_ = starts(rows.begin());
    }

    struct CellSample {
        Vec2 u;
        double inverse_density;
    };
    // Samples a place for a uniform u in [0, 1)².
    CellSample sample(const Vec2& u) const {
        const Choice row = choose(rows_, u.y), cell = choose(cells_[row.number], u.x);
        return {{cell.place, row.place}, row.inverse_density * cell.inverse_density};
    }
    double density(std::uint32_t cell) const { return density_in(rows_, cell / k) * density_in(cells_[cell / k], cell % k); }

private:
    static constexpr double parts = 65536.0;
    using Starts = std::array<std::uint16_t, k>;  // starts of consecutive intervals, in units of 2^-16

    static constexpr Weights uniform() {
        Weights weights{};
        weights.fill(1.0);
        return weights;
    }
    template <class Iterator>
    static Starts starts(Iterator weights) {
        const double sum = std::accumulate(weights, weights + k, 0.0);
        Starts starts;
        double before = 0.0;
        for (std::uint32_t i = 0; i < k; before += weights[i++])
            starts[i] = static_cast<std::uint16_t>(std::lround(before / sum * parts));
        return starts;
    }
    static double width(const Starts& starts, std::uint32_t i) { return (i + 1 < k ? starts[i + 1] : parts) - starts[i]; }
    static double density_in(const Starts& starts, std::uint32_t i) { return width(starts, i) * (k / parts); }

    struct Choice {
        std::uint32_t number;
        double place, inverse_density;
    };
    static Choice choose(const Starts& starts, double u) {
        const double scaled = u * parts;
        const auto whole = static_cast<std::uint32_t>(scaled);
        std::uint32_t i = ~0u;  // ~0, because the first interval starts at 0, so the loop adds at least 1
        for (std::uint32_t j = 0; j < k; ++j) i += whole >= starts[j] ? 1u : 0u;
        const double inverse_width = 1.0 / width(starts, i);
        constexpr double below_one = 1.0 - 0x1p-53;
        return {i, (i + std::min((scaled - starts[i]) * inverse_width, below_one)) * (1.0 / k), inverse_width * (parts / k)};
    }

    Starts rows_;
    std::array<Starts, k> cells_;  // cells of each row
};

}  // namespace neumann
