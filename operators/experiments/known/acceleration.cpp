// The number of applications of K that each method takes on the cube of 16 × 16 patches a face whose ceiling emits,
// until ‖x − L‖∞ ≤ ε ‖L‖∞ for ε = 1e-3, 1e-6, 1e-10, with L by LU. The expected counts are from independent programs of
// the same methods: ours may differ by 2 or by 10%, because of the start of a method and the order of its rounding.
#include "operators/experiments/known/cube.h"
#include "operators/experiments/known/groups.h"
#include "operators/solvers/anderson.h"
#include "operators/solvers/chebyshev.h"
#include "operators/solvers/krylov.h"
#include "operators/solvers/lu.h"
#include "operators/solvers/series_solvers.h"

#include <fmt/format.h>
#include <algorithm>

namespace neumann::known {

namespace {

constexpr double goals[] = {1e-3, 1e-6, 1e-10};
using Counts = std::array<double, 3>;

struct Acceleration {
    Cube cube;
    Vector rho;
    DenseChannel K;
    Problem problem;
    Vector exact;

    Acceleration(Cube c, Vector r) : cube(std::move(c)), rho(std::move(r)), K(cube.channel(rho)) {
        problem.K = &K;
        problem.Le = cube.ceiling();
        problem.reflectance = &rho;
        problem.tolerance = 1e-14;
        exact = solve_lu(problem).x;
        problem.exact = &exact;
    }
    Acceleration(const Acceleration&) = delete;
    Acceleration& operator=(const Acceleration&) = delete;

    // The number of applications after which the error first reached each goal; 0 if it never did.
    Counts counts(const Solver& solve, int most) {
        problem.most = most;
        const SolverResult result = solve(problem);
        Counts found{};
        for (std::size_t i = 0; i < 3; ++i)
            for (const SolverStep& step : result.history)
                if (step.error <= goals[i]) {
                    found[i] = step.applications - result.setup;
                    break;
                }
        return found;
    }
};

// Expected counts; a count of 0 is not compared.
struct Expected {
    Counts neumann, ratio, aitken, wynn, vector_epsilon, exact_interval, safe_interval, low_top, gmres, cg;
    std::array<double, 3> anderson;  // m = 1, 3, 8, to 1e-6
    int most_by_wynn = 0;            // to 1e-10, where rounding in the sums decides
};

void compare(Figures& figures, Acceleration& cube, const Expected& expected, double lowest, double highest, double largest_albedo) {
    const auto add = [&](const std::string& method, const Solver& solve, const Counts& known, int most) {
        const Counts found = cube.counts(solve, most);
        for (std::size_t i = 0; i < 3; ++i)
            if (known[i] > 0)
                figures.near(fmt::format("{}, {:g}", method, goals[i]), found[i], known[i], std::max(2.0, 0.1 * known[i]));
    };
    const auto chebyshev = [](double low, double high) {
        return [low, high](const Problem& problem) { return solve_chebyshev(problem, low, high); };
    };
    add("series", solve_neumann, expected.neumann, 24000);
    add("ratio tail", solve_ratio_tail, expected.ratio, 60);
    add("Aitken", solve_aitken, expected.aitken, 60);
    add("Wynn", solve_wynn_epsilon, expected.wynn, 60);
    add("vector epsilon", solve_vector_epsilon, expected.vector_epsilon, 60);
    add("Chebyshev, exact", chebyshev(lowest, highest), expected.exact_interval, 1200);
    add("Chebyshev, safe", chebyshev(-largest_albedo, largest_albedo), expected.safe_interval, 1200);
    add("Chebyshev, 0.1% low", chebyshev(lowest, 0.999 * highest), expected.low_top, 1200);
    add(
        "GMRES", [](const Problem& problem) { return solve_gmres(problem); }, expected.gmres, 40);
    add("CG", solve_conjugate_gradients, expected.cg, 40);
    const int m[] = {1, 3, 8};
    for (std::size_t i = 0; i < 3; ++i)
        add(
            fmt::format("Anderson {}", m[i]), [&](const Problem& problem) { return solve_anderson(problem, m[i]); },
            {0, expected.anderson[i], 0}, 800);
    if (expected.most_by_wynn > 0) figures.at_most("Wynn, 1e-10", cube.counts(solve_wynn_epsilon, 60)[2], expected.most_by_wynn);
}

void add_uniform(Cases& cases, double rho, double lowest, const Expected& expected) {
    cases.push_back(
        {fmt::format("acceleration/albedo-{:g}", rho), "counts of other programs: 2 or 10%", [=](Figures& figures, std::uint64_t) {
             const Cube cube = symmetric_cube(16);
             Acceleration problem(cube, Vector::Constant(cube.size(), rho));
             compare(figures, problem, expected, lowest, rho, rho);
         }});
}

}  // namespace

Cases acceleration_cases() {
    Cases cases;
    add_uniform(cases, 0.9, -0.3481399890,
                {{61, 127, 214},
                 {10, 19, 32},
                 {13, 22, 34},
                 {12, 15, 22},
                 {10, 14, 19},
                 {13, 25, 42},
                 {16, 31, 51},
                 {14, 27, 46},
                 {7, 11, 15},
                 {7, 11, 15},
                 {40, 17, 10}});
    add_uniform(cases, 0.99, -0.3829539879,
                {{682, 1369, 2286},
                 {12, 23, 37},
                 {19, 30, 44},
                 {14, 18, 0},
                 {12, 17, 22},
                 {44, 85, 139},
                 {53, 102, 166},
                 {57, 114, 191},
                 {8, 11, 16},
                 {8, 11, 16},
                 {123, 26, 11},
                 27});
    add_uniform(cases, 0.999, -0.3864353878,
                {{6899, 13803, 23015},
                 {12, 23, 38},
                 {23, 34, 48},
                 {15, 19, 0},
                 {14, 18, 25},
                 {141, 270, 441},
                 {169, 324, 530},
                 {322, 645, 1075},
                 {9, 12, 16},
                 {8, 12, 16},
                 {615, 26, 12},
                 44});
    cases.push_back({"acceleration/mixed-albedos", "counts of other programs: 2 or 10%", [](Figures& figures, std::uint64_t) {
                         const Cube cube = patched_cube(16);
                         Acceleration problem(cube, cube.on_faces({.2, .5, .8, .9, .95, .7}));
                         compare(figures, problem,
                                 {{15, 32, 54},
                                  {7, 15, 25},
                                  {9, 16, 25},
                                  {9, 14, 20},
                                  {7, 12, 18},
                                  {7, 13, 21},
                                  {25, 45, 74},
                                  {7, 14, 23},
                                  {7, 11, 16},
                                  {7, 11, 16},
                                  {20, 13, 11}},
                                 -0.3418005946, 0.6622559027, 0.95);
                     }});
    return cases;
}

}  // namespace neumann::known
