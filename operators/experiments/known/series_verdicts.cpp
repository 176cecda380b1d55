// Bounds that stop a series (from norms, and by the two-sided enclosure), and series whose first terms or ratios mislead.
#include "operators/algebra/tail_bound.h"
#include "operators/experiments/known/cube.h"
#include "operators/experiments/known/groups.h"
#include "operators/experiments/known/small_problems.h"
#include "operators/solvers/lu.h"
#include "operators/solvers/series_run.h"
#include "operators/solvers/series_solvers.h"
#include "operators/solvers/solvers.h"

#include <fmt/format.h>

namespace neumann::known {

namespace {

// Mixed albedos, 16² patches a face: t_{n−1} against t_n; the width of the enclosure, the norm bound of S_n and its
// true tail relative to ‖L‖∞.
void enclosures_of_cube(Figures& figures, std::uint64_t) {
    struct Row {
        int n;
        double c1, c2, width, bound, tail;
    };
    const Row rows[] = {
        {5, 0.5138180074090534, 0.8032587428707869, 8.38228739007892e-2, 0.5263211301607131, 0.053111687048543514},
        {8, 0.6467113110831977, 0.6809939422546191, 2.408567908375121e-3, 0.15044127772679844, 0.015777789376206303},
        {12, 0.6611265176542338, 0.6643522929078157, 4.397083129864574e-5, 0.029458148131107566, 0.0030449503372995523},
        {16, 0.6621676895838545, 0.6625043154258586, 8.821492623268e-7, 0.0056769834858819805, 0.0005859710348624664},
        {24, 0.662255079198025, 0.6622598142276755, 4.590114439222745e-10, 0.0002100999651593624, 2.1682606323683657e-05}};
    const Cube cube = patched_cube(16);
    const DenseChannel K = cube.channel(cube.on_faces({.2, .5, .8, .9, .95, .7}));
    Problem problem;
    problem.K = &K;
    problem.Le = cube.ceiling();
    const Vector exact = solve_lu(problem).x;
    for (const Row& row : rows) {
        const SeriesRun run = run_series(K, problem.Le, {.tolerance = 0.0, .most_bounces = row.n, .norm = 0.95});
        const Enclosure& found = run.enclosure;
        if (!found.exists) return figures.fail(fmt::format("enclosure, n = {}", row.n), found.why);
        const auto named = [&](const char* what) { return fmt::format("{}, n = {}", what, row.n); };
        figures.near(named("c1"), found.c1, row.c1, 1e-9);
        figures.near(named("c2"), found.c2, row.c2, 1e-9);
        figures.near(named("width"), (found.high - found.low).maxCoeff() / exact.maxCoeff(), row.width, 1e-4 * row.width);
        figures.near(named("norm bound"), run.rows[static_cast<std::size_t>(row.n)].a_posteriori / exact.maxCoeff(), row.bound,
                     1e-9);
        figures.near(named("true tail"), (exact - run.sum).maxCoeff() / exact.maxCoeff(), row.tail, 1e-9);
        // The tolerance of 1e-13 is for rounding, which the enclosure ignores.
        figures.holds(named("holds L"),
                      (found.low.array() <= exact.array() + 1e-13).all() && (found.high.array() >= exact.array() - 1e-13).all());
    }
}

// ‖Σ_{k>n} t_k‖ against a^(n+1)/(1 − a) and a/(1 − a) ‖t_n‖, which are both exact in a furnace.
void bounds_of_furnace(Figures& figures, std::uint64_t) {
    for (const double a : {0.5, 0.9, 0.99, 0.999}) {
        const double L = 1.0 / (1.0 - a), tail = std::pow(a, 6) * L;
        figures.near(fmt::format("bound beyond bounce 5, albedo {:g}", a), tail_bound(Rgb(a), Rgb(1.0), 5), tail, 1e-14 * tail);
        const SeriesRun run = run_series(furnace(a), Vector::Ones(3), {.tolerance = 1e-12, .norm = a});
        figures.near(fmt::format("from the terms, bounce 1, albedo {:g}", a), run.rows[1].a_posteriori, a * a * L, 1e-12 * L);
        figures.near(fmt::format("sum, albedo {:g}", a), run.sum[0], L, 1e-11 * L);
    }
    figures.holds("no bound at albedo 1", std::isinf(tail_bound(Rgb(1.0), Rgb(1.0), 5)));
}

// Ratios of successive terms alternate between 0.018 and 44; every second term falls evenly and gives an enclosure.
void alternating(Figures& figures, std::uint64_t) {
    const DenseChannel K = plates();
    const SeriesRun run = run_series(K, vector({1, 0}), {.tolerance = 1e-6, .norm = 0.9});
    figures.equal("verdict", name(run.verdict), "converged");
    const double outer[] = {.88209, .0157982319, .7005574376233291, .02508889984683773, .5566085813341031};
    TermSeries series(K, vector({1, 0}));
    double before = 0.0;
    for (int n = 1; n <= 5; ++n) {
        series.advance();
        if (n > 1)
            figures.near(fmt::format("ratio at bounce {}, outer", n), series.term()[1] / before, outer[n - 1] / outer[n - 2],
                         1e-9 * outer[n - 1] / outer[n - 2]);
        before = series.term()[1];
    }
    figures.near("ratio of largest terms, bounce 3", run.rows[3].term.sup / run.rows[2].term.sup, 0.882446409, 1e-9);
    figures.near("ratio of largest terms, bounce 4", run.rows[4].term.sup / run.rows[3].term.sup, 0.9, 1e-12);
    const double determinant = (1 - .01791) - .9 * .88209;
    figures.near("L, inner", run.sum[0], (1 - .01791) / determinant, 1e-6 * (1 - .01791) / determinant);
    figures.near("L, outer", run.sum[1], .88209 / determinant, 1e-6 * (1 - .01791) / determinant);
}

// t_n = 0.5^n + 1e-6 · 0.99^n in two rooms: the ratio in the bright room predicts a tail 25 times too small at n = 20.
void hidden_slow(Figures& figures, std::uint64_t) {
    const DenseChannel K = separate_rooms(0.5, 0.99);
    const Vector Le = vector({1, 1e-6});
    const std::vector<SeriesRow> rows = run_series(K, Le, {.tolerance = 0.0, .most_bounces = 20}).rows;
    figures.near("ratio at bounce 10", rows[10].ratio, 0.5002290760634021, 1e-12);
    figures.near("ratio at bounce 15", rows[15].ratio, 0.5068765527547062, 1e-12);
    figures.near("ratio at bounce 20", rows[20].ratio, 0.6480958734373757, 1e-12);
    const double power = rows[20].term.power, ratio = rows[20].ratio;
    figures.near("true tail over the ratio's", 8.192646113853209e-05 / (power * ratio / (1 - ratio)), 25.11008731388987, 1e-8);
    const SeriesRun run = run_series(K, Le, {.tolerance = 1e-7, .norm = 0.99});
    figures.equal("verdict", name(run.verdict), "converged");
    figures.near("L, loud room", run.sum[0], 2.0, 2e-7);
    figures.near("L, slow room", run.sum[1], 1e-4, 2e-7);
}

// Light that circles between three mirrors, and light behind twenty of them: the series must not end because terms are
// 0 at an unknown, and must not be called divergent because its first terms do not fall.
void zeros(Figures& figures, std::uint64_t) {
    const SeriesRun round = run_series(carousel(0.9), vector({1, 0, 0}), {.tolerance = 1e-9, .norm = 0.9});
    figures.equal("period three: verdict", name(round.verdict), "converged");
    for (int k = 0; k < 3; ++k)
        figures.near(fmt::format("period three: L, mirror {}", k), round.sum[k], std::pow(0.9, k) / (1 - 0.729), 1e-8);
    constexpr int m = 20;
    DenseChannel::Matrix K = DenseChannel::Matrix::Zero(m + 1, m + 1);
    for (int u = 0; u < m; ++u) K(u + 1, u) = 1.0;
    const SeriesRun periscope = run_series(DenseChannel(K, Vector::Ones(m + 1)), Vector::Unit(m + 1, 0));
    figures.equal("periscope: verdict", name(periscope.verdict), "converged");
    figures.equal("periscope: why", periscope.why, "term 21 is 0, and so are all that follow");
}

// ‖K‖∞ = 1.6 and 2: both must raise a warning, but only the second series diverges, because K^i Le = ρ (mean ρ)^(i−1).
void norm_above_one(Figures& figures, std::uint64_t) {
    const SeriesRun run = run_series(sphere_halves(1.6, 0.2), Vector::Ones(2), {.tolerance = 1e-12, .norm = 1.6});
    figures.equal("albedos 1.6, 0.2: verdict", name(run.verdict), "converged");
    figures.near("warnings", static_cast<double>(run.warnings.size()), 1.0, 0.0);
    figures.near("L, bright half", run.sum[0], 17.0, 1e-10);
    figures.near("L, dark half", run.sum[1], 3.0, 1e-10);
    const SeriesRun above = run_series(sphere_halves(2.0, 0.2), Vector::Ones(2), {.norm = 2.0});
    figures.equal("albedos 2, 0.2: verdict", name(above.verdict), "diverging");
    figures.near("rate", above.rate, 1.1, 1e-12);
}

// A furnace of albedo 1.05, where (I − K)⁻¹ Le = −20 is not the sum of the series, although elimination, Krylov methods and
// extrapolation find it; and one of albedo 1, which has no L. No solver may say that it converged.
void add_divergent(Cases& cases) {
    for (const double albedo : {1.0, 1.05})
        cases.push_back({fmt::format("series/divergent/albedo-{:g}", albedo), "no solver may converge",
                         [albedo](Figures& figures, std::uint64_t) {
                             const DenseChannel K = furnace(albedo);
                             const Vector rho = Vector::Constant(3, albedo);
                             Problem problem;
                             problem.K = &K;
                             problem.Le = vector({1, 2, 3});
                             problem.tolerance = 1e-8;
                             problem.most = 2000;
                             problem.reflectance = &rho;
                             for (const NamedSolver& solver : solvers()) {
                                 const SolverResult result = solver.solve(problem);
                                 const bool claims = result.verdict == Verdict::converged;
                                 figures.equal(solver.name, claims ? "converged" : "not converged", "not converged");
                             }
                             if (albedo == 1.0) return;
                             problem.Le = Vector::Ones(3);
                             for (const char* solver : {"aitken", "wynn", "vector-epsilon", "gmres", "bicgstab", "lu"}) {
                                 const SolverResult result = find_solver(solver)->solve(problem);
                                 figures.equal(fmt::format("{}: verdict", solver), name(result.verdict), "refused");
                                 figures.near(fmt::format("{}: 1/(1 - albedo)", solver), result.x[0], -20.0, 1e-6);
                             }
                         }});
}

// Near-parallel plates, relative errors at the outer one after n terms. Aitken gains nothing over the plain sum, the
// ratio of terms gains a factor from 15 down to 1.4, and Wynn, with as many terms as there are modes, is exact.
void extrapolation(Figures& figures, std::uint64_t) {
    const DenseChannel K = plates();
    Problem problem;
    problem.K = &K;
    problem.Le = vector({1, 0});
    problem.tolerance = 0.0;
    const double exact = .88209 / (1 - .01791 - .9 * .88209);
    struct Row {
        int n;
        double plain, aitken;
    };
    for (const Row& row : {Row{4, 0.6535911100153163, 0.6533922783274924}, Row{10, 0.34553574853669067, 0.3448779621515211},
                           Row{40, 0.014376681667732316, 0.013929698920867373}}) {
        problem.most = row.n;
        const auto error = [&](const Solver& solve) { return std::abs(solve(problem).x[1] / exact - 1.0); };
        figures.near(fmt::format("plain sum of {}", row.n), error(solve_neumann), row.plain, 1e-12);
        figures.near(fmt::format("Aitken, {}", row.n), error(solve_aitken), row.aitken, 1e-12);
        figures.near(fmt::format("Wynn, {}", row.n), error(solve_wynn_epsilon), 0.0, 1e-12);
        figures.equal(fmt::format("one ratio, {}", row.n), name(solve_ratio_tail(problem).verdict), "refused");
    }
    const DenseChannel round = carousel(0.9);
    problem.K = &round;
    problem.Le = vector({1, 0, 0});
    problem.most = 30;
    figures.equal("period three, Aitken", name(solve_aitken(problem).verdict), "broke down");
    figures.equal("period three, one ratio", name(solve_ratio_tail(problem).verdict), "refused");
}

}  // namespace

Cases series_cases() {
    Cases cases;
    cases.push_back({"series/enclosures", "Collatz and Wielandt, Galerkin's method: 1e-9", enclosures_of_cube});
    cases.push_back({"series/bounds", "a^(n+1)/(1 - a): exact", bounds_of_furnace});
    cases.push_back({"series/alternating", "2 x 2 matrix: exact", alternating});
    cases.push_back({"series/hidden-slow", "0.5^n + 1e-6 0.99^n: exact", hidden_slow});
    cases.push_back({"series/zero-terms", "period 3 and periscope: exact", zeros});
    cases.push_back({"series/norm-above-1", "17 and 3: exact", norm_above_one});
    cases.push_back({"series/extrapolation", "2 x 2 matrix: exact", extrapolation});
    add_divergent(cases);
    return cases;
}

}  // namespace neumann::known
