#include "operators/paths/cache/hemisphere_cells.h"

#include "core/sampling/warp.h"

#include <algorithm>
#include <cmath>

namespace neumann {

HemisphereCells::HemisphereCells(std::uint32_t rays)
    : rings_(std::max(static_cast<std::uint32_t>(std::lround(std::sqrt(rays * inv_pi))), 1u)),
      sectors_(std::max(rays / rings_, 1u)) {
    const double N = sectors_;
    sector_sine_ = 2.0 * direction_on_circle(0.5 / N).y;
    for (std::uint32_t k = 0; k < sectors_; ++k) {
        middle_.push_back(direction_on_circle((k + 0.5) / N));
        edge_.push_back(direction_on_circle(k / N));
    }
    for (std::uint32_t j = 0; j <= rings_; ++j) sine_.push_back(std::sqrt(static_cast<double>(j) / rings_));
    // ∫ sin²θ dθ from the pole to the beginning of ring j.
    const auto integral = [&](std::uint32_t j) {
        return 0.5 * (std::asin(sine_[j]) - sine_[j] * std::sqrt(1.0 - static_cast<double>(j) / rings_));
    };
    for (std::uint32_t j = 0; j < rings_; ++j)
        for (std::uint32_t k = 0; k < sectors_; ++k)
            rotation_.push_back(middle_[k] * (sector_sine_ * (integral(j + 1) - integral(j))));
}

Vec3 HemisphereCells::direction(std::size_t cell, const Vec2& u) const {
    const auto j = static_cast<double>(cell / sectors_), k = static_cast<double>(cell % sectors_);
    const double sine2 = (j + u.x) / rings_;
    return Vec3(direction_on_circle((k + u.y) / sectors_) * std::sqrt(sine2), std::sqrt(1.0 - sine2));
}

double HemisphereCells::weight() const { return pi / static_cast<double>(size()); }

template <class Ring, class Sector>
void HemisphereCells::for_boundaries(const Ring& ring, const Sector& sector) const {
    for (std::size_t j = 0; j < rings_; ++j)
        for (std::size_t k = 0; k < sectors_; ++k) {
            const std::size_t cell = j * sectors_ + k;
            if (j > 0) ring(cell - sectors_, cell, sine_[j], k);
            sector(k > 0 ? cell - 1 : cell + sectors_ - 1, cell, j, edge_[k]);
        }
}

// At a boundary between rings, dl × q/|q| in the tangent plane is sinθ cosθ dφ along the boundary's direction û; at one
// between sectors, it is dθ along v̂, which is û turned by 90°.
void HemisphereCells::translation(std::span<const double> inverse_distances, std::span<Vec2> weights) const {
    std::ranges::fill(weights, Vec2(0.0));
    const auto add = [&](std::size_t cell, std::size_t next, const Vec2& w) {
        const Vec2 of_difference = w * std::max(inverse_distances[cell], inverse_distances[next]);
        weights[next] += of_difference;
        weights[cell] -= of_difference;
    };
    for_boundaries([&](std::size_t cell, std::size_t next, double sine,
                       std::size_t k) { add(cell, next, middle_[k] * (sector_sine_ * sine * (1.0 - sine * sine))); },
                   [&](std::size_t cell, std::size_t next, std::size_t j, const Vec2& u) {
                       add(cell, next, Vec2(-u.y, u.x) * (sine_[j + 1] - sine_[j]));
                   });
}

Vec3 HemisphereCells::hessian(std::span<const double> radiance, std::span<const double> inverse_distances) const {
    Vec3 all(0.0);
    const double of_ring = 2.0 * pi / sectors_, of_sector = 0.5 / rings_;  // ∫ cosθ sinθ dθ over a ring
    const auto add = [&](std::size_t cell, std::size_t next, double w, const Vec2& a, const Vec2& b) {
        const double inverse = std::max(inverse_distances[cell], inverse_distances[next]);
        all += Vec3(a.x * b.x, 0.5 * (a.x * b.y + a.y * b.x), a.y * b.y) *
               (4.0 * w * inverse * inverse * (radiance[next] - radiance[cell]));
    };
    for_boundaries(
        [&](std::size_t cell, std::size_t next, double sine, std::size_t k) {
            const double sine2 = sine * sine;
            add(cell, next, of_ring * sine2 * (1.0 - sine2), middle_[k], middle_[k]);
        },
        [&](std::size_t cell, std::size_t next, std::size_t, const Vec2& u) { add(cell, next, of_sector, Vec2(-u.y, u.x), u); });
    return all;
}

}  // namespace neumann
