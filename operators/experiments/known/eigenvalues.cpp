// Spectra: the cube patch by patch, mirrors with complex eigenvalues, norms that are not the spectral radius.
#include "operators/algebra/term_series.h"
#include "operators/experiments/known/cube.h"
#include "operators/experiments/known/groups.h"
#include "operators/experiments/known/small_problems.h"
#include "operators/solvers/spectrum/closure.h"
#include "operators/solvers/spectrum/spectrum.h"

#include <fmt/format.h>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>

namespace neumann::known {

namespace {

// λ₂(n) for n × n patches a face, of the whole cube. It grows with n without end towards 0.5945, the value of the
// corners, like 1/(ln n)²: K is not compact.
void add_cubes(Cases& cases) {
    for (const auto& [n, second] :
         {std::pair{2, 0.35378252258065523}, {4, 0.4473321313543558}, {8, 0.4969093656850799}, {16, 0.5253458862440682}})
        cases.push_back({fmt::format("spectrum/cube/{0}x{0}", n), "eigenvalues of Galerkin's method: 1e-10",
                         [n = n, second = second](Figures& figures, std::uint64_t) {
                             const Eigenpairs found = leading_eigenpairs(patched_cube(n).channel(1.0), 2);
                             figures.near("first eigenvalue", found.pairs.at(0).value.real(), 1.0, 1e-12);
                             figures.near("second eigenvalue", found.pairs.at(1).value.real(), second, 1e-10);
                             figures.near("imaginary part", found.pairs.at(1).value.imag(), 0.0, 1e-12);
                         }});
    cases.push_back({"spectrum/cube/mixed-albedos", "eigenvalues of Galerkin's method: 1e-11", [](Figures& figures, std::uint64_t) {
                         const Cube cube = patched_cube(16);
                         const DenseChannel K = cube.channel(cube.on_faces({.2, .5, .8, .9, .95, .7}));
                         figures.near("spectral radius", spectral_radius(K), 0.6622559026688091, 1e-11);
                         const OperatorNorms norms = operator_norms(K);
                         figures.near("maximum norm", norms.sup, 0.95, 1e-12);
                         // This is the inequality of Riesz and Thorin.
                         figures.at_most("|K|2^2 over |K|1 |K|max", norms.two * norms.two / (norms.one * norms.sup), 1.0 + 1e-12);
                         figures.at_least("|K|2", norms.two, 0.6622559026688091);
                     }});
}

// ‖K‖∞ = 1.6, spectral radius 0.9, ‖K‖₁ = 0.9; K = ρ 1ᵀ/2 has ‖K‖₂ = ‖ρ‖ ‖1‖/2.
void norms_of_sphere(Figures& figures, std::uint64_t) {
    const DenseChannel K = sphere_halves(1.6, 0.2);
    const OperatorNorms norms = operator_norms(K);
    figures.near("maximum norm", norms.sup, 1.6, 1e-15);
    figures.near("|K|1", norms.one, 0.9, 1e-15);
    figures.near("|K|2", norms.two, std::sqrt(2.6 / 2), 1e-14);
    figures.near("spectral radius", spectral_radius(K), 0.9, 1e-15);
    figures.near("spectral radius of the plates", spectral_radius(plates()), 0.9, 1e-15);
}

// A ring of three mirrors has the eigenvalues ρ e^{2πik/3}.
void ring(Figures& figures, std::uint64_t) {
    const Eigenpairs three = leading_eigenpairs(carousel(0.9), 3);
    double imaginary = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        figures.near(fmt::format("modulus of eigenvalue {}", k + 1), std::abs(three.pairs.at(k).value), 0.9, 1e-14);
        imaginary = std::max(imaginary, three.pairs[k].value.imag());
    }
    figures.near("largest imaginary part", imaginary, 0.9 * std::sqrt(3.0) / 2, 1e-14);
}

// Form factors from patch centre to patch centre, F ≈ G A/π, have row sums up to 1.27: the series diverges below albedo
// 1. The checks must show this defect.
void centre_to_centre(Figures& figures, std::uint64_t) {
    struct Row {
        int n;
        double largest_row, radius;
    };
    for (const Row& row :
         {Row{2, 1.2729893039, 1.2729893039}, Row{4, 1.2428650171, 1.1431238396}, Row{8, 1.2391144812, 1.0754847461}}) {
        Cube cube = patched_cube(row.n);
        for (Eigen::Index u = 0; u < cube.size(); ++u)
            for (Eigen::Index v = 0; v < cube.size(); ++v) {
                const auto i = static_cast<std::size_t>(u), j = static_cast<std::size_t>(v);
                if (cube.face[i] == cube.face[j]) continue;
                const Vec3 d = cube.patches[j].centre() - cube.patches[i].centre();
                const double r2 = glm::dot(d, d);
                cube.factors.F(u, v) = -glm::dot(d, cube.patches[i].normal()) * glm::dot(d, cube.patches[j].normal()) / (r2 * r2) *
                                       cube.factors.area[v] / pi;
            }
        const DenseChannel F = cube.channel(1.0);
        figures.near(fmt::format("largest row sum, {0} x {0}", row.n), row_sums(F).maxCoeff(), row.largest_row, 1e-9);
        figures.near(fmt::format("closure defect seen, {0} x {0}", row.n), closure_defect(F), row.largest_row - 1, 1e-9);
        figures.near(fmt::format("spectral radius, {0} x {0}", row.n), spectral_radius(F), row.radius, 1e-9);
    }
}

// A reflection c (μi μo)^a in a sphere, where T is the identity on functions of the angle: K f (μ) = 2π c μ^a ∫
// μ'^(a+1) f(μ') dμ', here with Gauss's points for μ', which are exact for polynomials. K^i 1 = 2π c μ^a/(a + 2) (2π
// c/(2a + 2))^(i−1); the largest row sum, which is the largest albedo, is not the spectral radius.
void power_of_cosines(Figures& figures, std::uint64_t) {
    using Gauss = boost::math::quadrature::gauss<double, 10>;
    constexpr double c = 0.25, a = 2.0;
    constexpr Eigen::Index half = 5, size = 2 * half;
    Vector mu(size), weight(size);
    for (Eigen::Index k = 0; k < half; ++k) {
        const double x = 0.5 * Gauss::abscissa()[static_cast<std::size_t>(k)];
        mu[k] = 0.5 - x;
        mu[half + k] = 0.5 + x;
        weight[k] = weight[half + k] = 0.5 * Gauss::weights()[static_cast<std::size_t>(k)];
    }
    const Vector measure = mu.cwiseProduct(weight), power = mu.array().pow(a);
    const DenseChannel K(2.0 * pi * c * power * measure.cwiseProduct(power).transpose(), measure);
    TermSeries series(K, Vector::Ones(size));
    int i = 0;
    for (const double value : {0.3926990817, 0.1028083792, 0.0269151707, 0.0070463752}) {
        series.advance();
        figures.near(fmt::format("K^{} Le, cosine 1", ++i), series.term()[size - 1] / power[size - 1], value, 1e-10);
    }
    figures.near("spectral radius", spectral_radius(K), pi / 12.0, 1e-14);
    figures.near("maximum norm", operator_norms(K).sup, pi / 8.0 * power[size - 1], 1e-14);
}

}  // namespace

Cases spectrum_cases() {
    Cases cases;
    add_cubes(cases);
    cases.push_back({"spectrum/norms", "algebra: exact", norms_of_sphere});
    cases.push_back({"spectrum/ring-of-mirrors", "rho e^(2 pi i k/3): exact", ring});
    cases.push_back({"spectrum/power-of-cosines", "2 pi c mu^a/(a + 2) (2 pi c/(2a + 2))^(i-1): exact", power_of_cosines});
    cases.push_back({"spectrum/centre-to-centre", "a known mistake: its size, 1e-9", centre_to_centre});
    return cases;
}

}  // namespace neumann::known
