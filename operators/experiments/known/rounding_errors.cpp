// Slow series added up naively and with compensation, in float and in double, compared with the bounds on their errors.
// u = ε/2 is the unit roundoff.
//
//     each term from the previous one    u ρ/(1−ρ)      for the sum: term k has k roundings, on average ρ/(1−ρ)
//     added one after another            u n            for n terms, or until the sum stops changing
//     added with compensation            2 u
//
// The exact sum is (1−ρ^n)/(1−ρ), with ρ after rounding.
#include "operators/algebra/compensated_sum.h"
#include "operators/experiments/known/cube.h"
#include "operators/experiments/known/groups.h"
#include "operators/solvers/spectrum/rounding_floor.h"

#include <fmt/format.h>

namespace neumann::known {

namespace {

struct Sums {
    double naive = 0.0, compensated = 0.0;  // relative errors
    int stagnates = -1;                     // the first n with S_{n+1} = S_n
};

// The errors of the sum of ρ^0 … ρ^terms.
template <class Real>
Sums add_up(double albedo, int terms) {
    using Values = Eigen::Matrix<Real, 1, 1>;
    const Real rho = static_cast<Real>(albedo);
    const double exact = -std::expm1((terms + 1) * std::log(static_cast<double>(rho))) / (1.0 - static_cast<double>(rho));
    CompensatedSum<Values> compensated(Values::Zero());
    Values t = Values::Ones();
    Real naive = 0;
    Sums sums;
    for (int k = 0; k <= terms; ++k, t[0] *= rho) {
        const Real next = naive + t[0];
        if (next == naive && sums.stagnates < 0) sums.stagnates = k - 1;
        naive = next;
        compensated.add(t);
    }
    sums.naive = static_cast<double>(naive) / exact - 1.0;
    sums.compensated = static_cast<double>(compensated.value()[0]) / exact - 1.0;
    return sums;
}

// `naive` and `stagnates`: in float, from another program.
void add_furnace(Cases& cases, double rho, int terms, double change, double naive, int stagnates) {
    cases.push_back({fmt::format("rounding/furnace/albedo-{:g}", rho), "float arithmetic elsewhere; n u, u rho/(1 - rho)",
                     [=](Figures& figures, std::uint64_t) {
                         const double in_float = static_cast<double>(static_cast<float>(rho));
                         figures.near("change by rounding rho to float", (1.0 - rho) / (1.0 - in_float) - 1.0, change,
                                      1e-3 * std::abs(change));
                         const Sums f = add_up<float>(rho, terms), d = add_up<double>(rho, terms);
                         const double u = 0x1p-24, v = 0x1p-53, of_terms = rho / (1.0 - rho);
                         figures.near("float, naive: error", f.naive, naive, 1e-6 * std::abs(naive) + 1e-15);
                         figures.at_most("float, naive: |error|", std::abs(f.naive), u * (terms + of_terms));
                         figures.near("float, naive: least n with S_(n+1) = S_n", f.stagnates, stagnates, 0.0);
                         figures.at_most("float, compensated: |error|", std::abs(f.compensated), u * (2.0 + of_terms));
                         figures.at_most("double, naive: |error|", std::abs(d.naive), v * (terms + of_terms));
                         figures.at_most("double, compensated: |error|", std::abs(d.compensated), v * (2.0 + of_terms));
                     }});
}

// The number of terms until the sum no longer changes, on the cube of 16 × 16 patches a face.
void stagnation_of_cube(Figures& figures, std::uint64_t) {
    const Cube cube = symmetric_cube(16);
    const auto of = [&](double rho, int most) { return stagnation<float>(cube.channel(rho), cube.ceiling(), most).value_or(0); };
    figures.near("float stagnates at, albedo 0.9", of(0.9, 2000), 140, 2);
    figures.near("float stagnates at, albedo 0.99", of(0.99, 2000), 1201, 12);
    figures.near("float stagnates at, albedo 0.999", of(0.999, 20000), 9986, 100);
    // ρ^n < 2^-53/(1 − ρ).
    figures.near("double stagnates at, albedo 0.9", stagnation<double>(cube.channel(0.9), cube.ceiling(), 2000).value_or(0),
                 std::log(0x1p-53 / 0.1) / std::log(0.9), 10);
    // The sum of the terms has the power 1/(1 − ρ), up to ρ^n.
    for (const auto& [rho, n] : {std::pair{0.9, 400}, {0.999, 40000}}) {
        const DenseChannel K = cube.channel(rho);
        TermSeries series(K, cube.ceiling());
        for (int k = 0; k < n; ++k) series.advance();
        const Vector sum = series.sum();
        const double found = cube.factors.area.dot(sum) * (1.0 - rho);
        // Rows of F sum to 1 up to about 1e-14, which 1/(1 − ρ) enlarges.
        figures.near(fmt::format("double, compensated: power, albedo {:g}", rho), found, 1.0, 1e-13 / (1.0 - rho));
    }
}

}  // namespace

Cases rounding_cases() {
    Cases cases;
    add_furnace(cases, 0.9, 219, -2.3841852243577929e-07, -4.290678287496755e-07, 138);
    add_furnace(cases, 0.99, 2521, 9.53675226753604e-07, -2.0980725878707618e-06, 1241);
    add_furnace(cases, 0.999, 27618, 1.2874769029963329e-05, -2.0809070430973913e-05, 10392);
    add_furnace(cases, 0.9999, 299270, -0.000165911799871701, -0.00033590174270099337, 76229);
    add_furnace(cases, 0.999999, 30000000, -0.01310494114809181, -0.02345100790256081, 3416055);
    cases.push_back({"rounding/cube", "float arithmetic elsewhere: 1%", stagnation_of_cube});
    return cases;
}

}  // namespace neumann::known
