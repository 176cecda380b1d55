// The light that enters a layer with a rough surface.
#pragma once

#include "core/material/roughness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace neumann {

// T, the fraction of light from one direction that enters, with single scattering by the facets, and F̄, the mean fraction that the
// facets reflect inside. Both are Mitsuba's sums: T is interpolated linearly between 64 equidistant cosines, and F̄ is 2/64 Σ R(μ) μ
// over these, 1.5% below the integral.
class RoughTransmittance {
public:
    // Computes both by Gauss quadrature over the visible facets.
    template <class Microfacets>
    RoughTransmittance(const Microfacets& facets, double eta);

    double operator()(double cosine) const {
        const double x = cosine * (nodes - 1);
        const int i = std::min(static_cast<int>(x), nodes - 2);
        return T_[i] + (x - i) * (T_[i + 1] - T_[i]);
    }
    // The mean over all directions, weighted by the cosine.
    double mean() const;
    double least() const { return *std::min_element(T_.begin(), T_.end()); }
    double largest() const { return *std::max_element(T_.begin(), T_.end()); }
    // F̄.
    double internal_reflectance() const { return internal_reflectance_; }

private:
    static constexpr int nodes = 64;
    std::array<double, nodes> T_;
    double internal_reflectance_ = 0.0;
};

// The same for all α from 0 to a largest one, interpolated linearly between some; or for one constant α alone.
class RoughTransmittances {
public:
    // T and F̄ for one α, a mixture of its neighbours in the table.
    class At {
    public:
        At(const RoughTransmittance& below, const RoughTransmittance& above, double share)
            : below_(below), above_(above), share_(share) {}
        double operator()(double cosine) const { return mixed(below_(cosine), above_(cosine)); }
        double internal_reflectance() const { return mixed(below_.internal_reflectance(), above_.internal_reflectance()); }

    private:
        double mixed(double a, double b) const { return share_ == 0.0 ? a : a + share_ * (b - a); }
        const RoughTransmittance &below_, &above_;
        double share_;
    };

    template <class Microfacets>
    RoughTransmittances(const Roughness<Microfacets>& roughness, double eta) {
        largest_ = roughness.alpha();
        if (roughness.is_constant())
            tables_.emplace_back(Microfacets(largest_), eta);
        else
            for (int i = 0; i <= steps; ++i) tables_.emplace_back(Microfacets(std::max(alpha_of(i), 1e-4)), eta);
    }

    At at(double alpha) const {
        if (tables_.size() == 1) return {tables_[0], tables_[0], 0.0};
        const int i = std::min(static_cast<int>(steps * std::sqrt(alpha / largest_)), steps - 1);
        const double below = alpha_of(i), above = alpha_of(i + 1);
        const auto at = static_cast<std::size_t>(i);
        return {tables_[at], tables_[at + 1], (alpha - below) / (above - below)};
    }
    const std::vector<RoughTransmittance>& tables() const { return tables_; }

private:
    static constexpr int steps = 32;
    // The α are closer together where the surface is almost smooth, because T changes most there, at grazing angles.
    double alpha_of(int i) const { return largest_ * i * i / (steps * steps); }

    double largest_ = 0.0;
    std::vector<RoughTransmittance> tables_;
};

}  // namespace neumann
