#include "operators/paths/corrected/shared_points.h"

#include "core/base/hot.h"
#include "core/sampling/warp.h"

#include <algorithm>
#include <cmath>

namespace neumann {

SharedPoints::SharedPoints(std::vector<Point> points, std::vector<Rgb> errors)
    : points_(std::move(points)), errors_(std::move(errors)), places_(points_.size() / candidates) {
    const std::vector<double> sizes = error_sizes();
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const Vec3 &y = points_[i].y.position, &normal = points_[i].normal;
        Candidates& c = places_[i % places_.size()];
        const std::size_t k = i / places_.size();
        c.x[k] = y.x;
        c.y[k] = y.y;
        c.z[k] = y.z;
        c.nx[k] = normal.x;
        c.ny[k] = normal.y;
        c.nz[k] = normal.z;
        c.size[k] = sizes[i];
        c.worth[k] = sizes[i] * points_[i].inverse_density;
    }
}

// For each point the root of Σ_k (ê_k / m_k)², with m_k the mean of |ê_k|, so that all bounces have equal weight.
std::vector<double> SharedPoints::error_sizes() const {
    const auto size_of = [&](std::size_t i, std::size_t k) { return max_component(glm::abs(carried_by(i)[k])); };
    std::vector<double> means(fields()), sizes(size());
    for (std::size_t i = 0; i < size(); ++i)
        for (std::size_t k = 0; k < fields(); ++k) means[k] += size_of(i, k) / static_cast<double>(size());
    for (std::size_t i = 0; i < size(); ++i) {
        for (std::size_t k = 0; k < fields(); ++k) {
            const double relative = means[k] > 0.0 ? size_of(i, k) / means[k] : 0.0;
            sizes[i] += relative * relative;
        }
        sizes[i] = std::sqrt(sizes[i]);
    }
    return sizes;
}

// Compiled with -fno-trapping-math (CMakeLists.txt): without it both sides of a choice may not be computed.
NEUMANN_HOT SharedPoints::Chosen SharedPoints::choose(const Vec3& x, const Vec3& normal, double clamp, double u) const {
    const double at = u * static_cast<double>(places_.size());
    const std::size_t place = std::min(static_cast<std::size_t>(at), places_.size() - 1);
    const Candidates& c = places_[place];
    double brings[candidates];
    for (std::size_t i = 0; i < candidates; ++i) {
        const double dx = c.x[i] - x.x, dy = c.y[i] - x.y, dz = c.z[i] - x.z, d2 = dx * dx + dy * dy + dz * dz;
        const double a = normal.x * dx + normal.y * dy + normal.z * dz, b = -(c.nx[i] * dx + c.ny[i] * dy + c.nz[i] * dz);
        const double g = a * b * inv_pi / (d2 * d2), kept = (g < clamp ? g : clamp) * c.worth[i];
        brings[i] = ((a > 0.0) & (b > 0.0)) ? kept : 0.0;
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < candidates; ++i) sum += brings[i];
    // The remaining randomness of u chooses among the candidates.
    double left = (at - static_cast<double>(place)) * sum;
    std::size_t chosen = candidates;
    for (std::size_t i = 0; i < candidates; ++i) {
        if (!(brings[i] > 0.0)) continue;
        chosen = i;
        if (left < brings[i]) break;
        left -= brings[i];
    }
    if (chosen == candidates) return {0, 0.0};
    return {static_cast<std::uint32_t>(place + chosen * places_.size()), sum / (static_cast<double>(candidates) * c.size[chosen])};
}

}  // namespace neumann
