// Form factors between flat patches that see each other unobstructed:
//
//     A_a F_ab = A_b F_ba = ∫_a ∫_b cosθ_a cosθ_b / (π r²) dA_b dA_a
//
// Pairs far apart are integrated by tensor Gauss rules. For near and adjacent pairs, where the integrand is steep or singular,
// parallel and perpendicular rectangles have closed forms (J. R. Howell, A Catalog of Radiation Heat Transfer Configuration
// Factors, C-13 and C-15), evaluated in long double. Far apart these are sums of 16 terms that cancel: the error grows like
// (distance / size)⁴.
#pragma once

#include "core/base/vec.h"
#include "operators/solvers/matrix_channel.h"

#include <array>
#include <map>
#include <vector>

namespace neumann {

// The points corner + s u + t v, 0 ≤ s, t ≤ 1; radiates and receives on the side of u × v. Lengths in scene units.
struct Parallelogram {
    Vec3 corner, u, v;

    Vec3 normal() const { return glm::normalize(glm::cross(u, v)); }
    Vec3 centre() const { return corner + 0.5 * (u + v); }
    double area() const { return glm::length(glm::cross(u, v)); }
};

// The nu × nv cells of a face; the cell (i, j) along u and v has index i nv + j.
std::vector<Parallelogram> cells(const Parallelogram& face, int nu, int nv);

// A_a F_ab, with a relative error of about 10⁻¹⁵ for cells of similar size; 0 if one lies in or behind the other's plane. Throws
// std::invalid_argument if a patch crosses the other's plane or has no area, and if a near pair has no closed form.
double exchange_area(const Parallelogram& a, const Parallelogram& b);

// Exchange areas of many pairs, cached: on grids of equal cells most pairs are congruent, and each kind is integrated once.
class ExchangeAreas {
public:
    double operator()(const Parallelogram& a, const Parallelogram& b);

private:
    double unit_ = 0.0;  // lengths are compared in this unit, 2⁻⁴⁰ of the first patch
    std::map<std::array<long long, 8>, double> known_;
};

struct FormFactors {
    DenseChannel::Matrix F;  // F_ab
    Vector area;
};

// The form factors are not renormalised: rows sum to 1, up to the accuracy of the integrals, if the patches enclose their room.
FormFactors form_factors(const std::vector<Parallelogram>& patches);

}  // namespace neumann
