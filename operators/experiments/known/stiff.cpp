// Series that fall slowly, start late, or fall at different rates in different places, by every method. In a closed
// room of albedo 0.9 to 1.01, K^i Le = ρ^i, and the rest beyond bounce N is ρ^(N+1)/(1−ρ). From albedo 1 on there is no
// sum, and no method may report one.
#include "core/geometry/area_sampler.h"
#include "operators/experiments/known/cube.h"
#include "operators/experiments/known/groups.h"
#include "operators/experiments/known/scene_maker.h"
#include "operators/experiments/known/small_problems.h"
#include "operators/fields/matrix/series_rest.h"
#include "operators/fields/matrix/traced_system.h"
#include "operators/render/from_paths/pilot.h"
#include "operators/render/methods/render.h"
#include "operators/solvers/lu.h"
#include "operators/solvers/series_run.h"
#include "operators/solvers/solvers.h"

#include <fmt/format.h>
#include <algorithm>

namespace neumann::known {

namespace {

constexpr double albedos[] = {0.9, 0.99, 0.999, 0.999999, 1.0, 1.01};

// A sphere: all points of its surface see each other equally, so no technique has infinite variance.
Scene furnace_with_camera(double rho) {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, glowing(rho, 1.0));
    maker.parts.camera.fov = 2.0;
    maker.parts.camera.near_clip = 1e-3;
    maker.parts.film = {4, 4, 0, 0, 4, 4, BoxFilter()};
    return maker.make();
}
double rest_of(double rho, int bounces) { return std::pow(rho, bounces + 1) / (1.0 - rho); }

// The mean of a term that was rendered in 64 replicates.
Statistic mean_of(const BounceSeries& series, int i) {
    const MeanWithError m = series.means_of_term(static_cast<std::size_t>(i)).all;
    return {Rgb(m.mean), Rgb(m.standard_error)};
}
Statistic mean_of_rest(const BounceSeries& series) {
    return {Rgb(series.means_of_rest->all.mean), Rgb(series.means_of_rest->all.standard_error)};
}

struct Sampling {
    Method method;
    std::uint32_t samples;  // per pixel, in each of 64 replicates
    int bounces = 8;
    double largest_rest = 0.0;  // largest albedo at which the rest is sampled to 0.2%
};
std::vector<Sampling> samplings() {
    return {{method::Walk{}, 16, 8, 0.9},
            {method::Guided{{}, 100, 2048}, 32, 8, 0.9},
            {method::Corrected{{}, 100, 32}, 16, 4},
            {method::Surface{}, 16},
            {method::Light{}, 2048, 2},
            {method::Bidirectional{}, 32, 4},
            {method::Classic{}, 16},
            {method::Pointwise{}, 16, 5}};
}

void by_sampling(Figures& figures, std::uint64_t seed, const Sampling& sampling, double rho) {
    const Scene scene = furnace_with_camera(rho);
    Goal goal{.bounces = sampling.bounces, .samples = batch_count * sampling.samples, .replicates = batch_count, .seed = seed};
    const BounceSeries found = render(scene, sampling.method, goal);
    // If only mirrors continue paths, all others end after the first reflection.
    const bool only_direct = found.paths == Paths::specular;
    for (int i = 1; i <= sampling.bounces; ++i)
        if (i <= 2 || i == sampling.bounces)
            figures.sampled(fmt::format("K^{} Le{}", i, only_direct && i > 1 ? ", not made" : ""), mean_of(found, i),
                            only_direct && i > 1 ? 0.0 : std::pow(rho, i));
    figures.near("samples that are no numbers", static_cast<double>(std::get<PathRecord>(found.record).health->non_finite()), 0.0,
                 0.0);
    if (sampling.largest_rest < rho) return;
    // The rest has a geometric distribution: its relative standard error is 1.05/√(samples) if every walk goes on.
    goal.samples = batch_count * 2048;
    Method independent = sampling.method;
    std::visit(
        [](auto& m) {
            if constexpr (requires { m.sampler; }) m.sampler = SamplerKind::independent;
        },
        independent);
    figures.sampled(fmt::format("sum of K^i Le, i > {}", sampling.bounces), mean_of_rest(render(scene, independent, goal)),
                    rest_of(rho, sampling.bounces));
}

// Checks whether the walks show that the series converges. They do not from albedo 1 on, nor at 0.999999, where the
// series is longer than the walks are followed.
void by_pilot(Figures& figures, std::uint64_t seed, double rho) {
    const Scene scene = furnace_with_camera(rho);
    const Pilot pilot(scene, {}, seed);
    figures.equal("the series", pilot.converges() ? "converges" : "does not converge, or too slowly to tell",
                  rho < 0.9999 ? "converges" : "does not converge, or too slowly to tell");
    // Walks have no variance here, except that of light sampling.
    figures.near("K^8 Le", pilot.term(8).mean, std::pow(rho, 8), z_limit * pilot.term(8).standard_error + 1e-12);
}

template <HasFields M>
Method with_fields(M m) {
    m.patches = 200;
    m.directions = batch_count * 16;
    return m;
}

void by_fields(Figures& figures, std::uint64_t seed, const Method& method, double rho) {
    const BounceSeries found = render(furnace_with_camera(rho), method,
                                      {.bounces = 8, .samples = batch_count * 8, .replicates = batch_count, .seed = seed});
    for (const int i : {1, 2, 8})
        figures.sampled(fmt::format("K^{} Le", i), mean_of(found, i), std::pow(rho, i),
                        // Pixels are floats.
                        1e-6);
    figures.equal("the rest", found.rest ? "converges" : "does not", rho < 1.0 ? "converges" : "does not");
    if (rho < 1.0) {
        const double exact = rest_of(rho, 8);
        // Rows of T sum to 1 up to rounding, which 1/(1 − ρ) enlarges.
        figures.near("sum of K^i Le, i > 8", found.means_of_rest->all.mean / exact, 1.0,
                     10.0 * closing_error + 1e-6 + 1e-13 / (1.0 - rho));
    }
}

// Every solver must either give (I − K)⁻¹ Le, whose power is 1/(1−ρ) times that of Le, or report that it does not.
void by_solvers(Figures& figures, std::uint64_t, double rho) {
    const Cube cube = symmetric_cube(8);
    const DenseChannel K = cube.channel(rho);
    const Vector reflectance = Vector::Constant(cube.size(), rho);
    Problem problem;
    problem.K = &K;
    problem.Le = cube.ceiling();
    problem.tolerance = 1e-8;
    problem.most = 3000;
    problem.reflectance = &reflectance;
    problem.radius = rho;
    int right = 0;
    for (const NamedSolver& solver : solvers()) {
        const SolverResult result = solver.solve(problem);
        if (result.verdict != Verdict::converged) {
            figures.holds(fmt::format("{}: {}, and why", solver.name, name(result.verdict)), !result.why.empty());
            continue;
        }
        ++right;
        figures.near(fmt::format("{}: power of L over that of Le, x (1 - rho)", solver.name),
                     cube.factors.area.dot(result.x) * (1.0 - rho), 1.0, 1e-7);
    }
    if (rho < 1.0)
        figures.at_least("solvers that converge", right, 3);
    else
        figures.near("solvers that converge", right, 0, 0);
}

// Twelve rooms in a row with a light in the last one. A tenth of each room's light goes to either neighbour. The first room is dark
// for eleven bounces, and then becomes brighter over many.
void chain_of_rooms(Figures& figures, std::uint64_t) {
    constexpr Eigen::Index rooms = 12;
    constexpr double rho = 0.99, door = 0.1;
    DenseChannel::Matrix K = DenseChannel::Matrix::Zero(rooms, rooms);
    for (Eigen::Index u = 0; u < rooms; ++u)
        for (const Eigen::Index v : {u - 1, u + 1}) {
            const bool wall = v < 0 || v == rooms;
            K(u, wall ? u : v) += rho * door;
            K(u, u) += rho * (0.5 - door);
        }
    const DenseChannel channel(K, Vector::Ones(rooms));
    Problem problem;
    problem.K = &channel;
    problem.Le = Vector::Unit(rooms, rooms - 1);
    const Vector exact = solve_lu(problem).x;
    TermSeries series(channel, problem.Le);
    int first = 0, brightest = 0;
    double most = 0.0;
    for (int n = 0; n < 400; ++n, series.advance()) {
        const double here = series.term()[0];
        if (first == 0 && here > 0.0) first = n;
        if (here > most) {
            most = here;
            brightest = n;
        }
    }
    figures.near("first bounce with light", first, rooms - 1, 0);
    figures.at_least("brightest bounce", brightest, 5 * rooms);
    for (const double tolerance : {1e-2, 1e-6}) {
        const SeriesRun run = run_series(channel, problem.Le, {.tolerance = tolerance, .norm = rho});
        figures.equal(fmt::format("verdict, to {:g}", tolerance), name(run.verdict), "converged");
        figures.near(fmt::format("L in the first room, to {:g}", tolerance), run.sum[0] / exact[0], 1.0,
                     tolerance * exact.maxCoeff() / exact[0]);
    }
    const SeriesRun early = run_series(channel, problem.Le, {.tolerance = 1e-2, .most_bounces = 10, .norm = rho});
    figures.equal("verdict where it is still dark", name(early.verdict), "limit");
    for (const NamedSolver& solver : solvers()) {
        problem.radius = rho;
        problem.tolerance = 1e-8;
        problem.most = 3000;
        const SolverResult result = solver.solve(problem);
        if (result.verdict != Verdict::converged)
            figures.holds(fmt::format("{}: {}, and why", solver.name, name(result.verdict)), !result.why.empty());
        else
            figures.near(fmt::format("{}: L in the first room", solver.name), result.x[0] / exact[0], 1.0, 1e-6);
    }
}

// Two rooms with a door ajar between them. The light is in one; the point is in the other and sees neither the light
// nor the surfaces that it shines on. All emitted light is absorbed: Σ_{i≥1} ∫ (1 − ρ)/ρ K^i Le dA = ∫ Le dA.
Scene rooms_with_door(double rho) {
    SceneMaker maker;
    const auto add = [&](const TriangleMesh& mesh) { maker.add(mesh, matte(rho)); };
    for (const double x : {0.0, 1.1}) {
        const auto faces = room({x, 0, 0}, {x + 1.0, 1, 1});
        for (std::size_t i = 0; i < 6; ++i)
            if (i != (x == 0.0 ? right : left)) add(faces[i]);
    }
    // The wall between is 0.1 thick, with an opening 0.15 wide and 0.5 high at y = 0.
    for (const double x : {1.0, 1.1}) {
        const auto facing = [&](const Vec3& corner, const Vec3& a, const Vec3& b) {
            add(x == 1.0 ? flipped(parallelogram(corner, a, b)) : parallelogram(corner, a, b));
        };
        facing({x, 0.15, 0}, {0, 0.85, 0}, {0, 0, 1});
        facing({x, 0, 0.5}, {0, 0.15, 0}, {0, 0, 0.5});
    }
    add(parallelogram({1, 0, 0}, {0.1, 0, 0}, {0, 0.15, 0}));
    add(flipped(parallelogram({1, 0, 0.5}, {0.1, 0, 0}, {0, 0.15, 0})));
    add(flipped(parallelogram({1, 0, 0}, {0.1, 0, 0}, {0, 0, 0.5})));
    add(parallelogram({1, 0.15, 0}, {0.1, 0, 0}, {0, 0, 0.5}));
    maker.add(parallelogram({1.3, 0.6, 0.999}, {0, 0.3, 0}, {0.3, 0, 0}), glowing(rho, 10.0));
    // This is the back of the light.
    add(flipped(parallelogram({1.3, 0.6, 0.999}, {0, 0.3, 0}, {0.3, 0, 0})));
    return maker.make();
}

void light_behind_a_door(Figures& figures, std::uint64_t seed) {
    const double rho = 0.8, emitted = 10.0 * 0.3 * 0.3;
    const Scene scene = rooms_with_door(rho);
    // The place is on the wall beside the door.
    const StartPicker here = at(scene, {1.0, 0.9, 0.2}, {-1, 0, 0});
    const Estimates found =
        probe(scene, here, Technique::mis, {.samples = 8192, .bounces = 4, .rest_probability = 1.0, .seed = seed});
    figures.near("K Le", found.terms[1].mean.r, 0.0, 0.0);
    figures.at_least("K^3 Le over K^2 Le", found.terms[3].mean.r / found.terms[2].mean.r, 1.5);
    figures.at_least("K^4 Le over K^3 Le", found.terms[4].mean.r / found.terms[3].mean.r, 1.0);
    // The rest beyond the dark bounces is all the light there is.
    const Estimates early =
        probe(scene, here, Technique::mis, {.samples = 8192, .bounces = 1, .rest_probability = 1.0, .seed = seed + 1});
    figures.near("sum so far, at bounce 1", early.terms[0].mean.r + early.terms[1].mean.r, 0.0, 0.0);
    const double both = std::hypot(early.rest.standard_error.r, found.reflected.standard_error.r);
    figures.near("rest at bounce 1, and all K^i Le", early.rest.mean.r, found.reflected.mean.r, z_limit * both);
    figures.at_most("relative error of that", both / found.reflected.mean.r, 0.02);
    const StartPicker absorbed = [pick = anywhere(scene), rho](Random& random) {
        Start start = pick(random);
        start.weight = grey((1.0 - rho) / rho);
        return start;
    };
    figures.sampled(
        "absorbed/emitted",
        scaled(sharp_probe(scene, absorbed, Technique::mis, {.samples = 1024, .bounces = 0, .rest_probability = 1.0, .seed = seed})
                   .reflected,
               AreaSampler(scene.geometry).area() / emitted),
        1.0);
    const TracedSystem system(scene, {.patches = 2000, .rays = 64, .seed = seed});
    const TracedChannel K = system.channel(0);
    const SeriesRun run = run_series(K, system.emitted(0), {.tolerance = 1e-6, .norm = rho});
    figures.equal("matrix: verdict", name(run.verdict), "converged");
    // A traced T conserves flux only approximately: 64 rays from each of 2000 patches.
    const double power = (1.0 - rho) * K.measure().dot(run.sum) / K.measure().dot(system.emitted(0));
    figures.near("matrix: absorbed/emitted", power, 1.0, 0.05);
}

// ρ = 0.5 with Le = 1 and ρ = 0.99 with Le = 1e-6 do not see each other: over both, t_n = 0.5^n + 1e-6 · 0.99^n. A
// sixteenth of each net starts in the first, which has almost nothing of the rest, with 16 times the weight.
void two_furnaces(Figures& figures, std::uint64_t seed) {
    SceneMaker maker;
    maker.add(make_cube(Mat4(1.0), true), glowing(0.5, 1.0));
    maker.add(Sphere{{5, 0, 0}, 1.0, true}, glowing(0.99, 1e-6));
    const Scene scene = maker.make();
    const SurfacePoint one = surface_point(scene, {-1, 0, 0}, {1, 0, 0}), other = surface_point(scene, {5, 0, 1}, {0, 0, -1});
    const StartPicker both = [=](Random& random) {
        constexpr double share = 1.0 / 16.0;
        const bool is_first = random.next() < share;
        const SurfacePoint& p = is_first ? one : other;
        return Start{p, p.normal, grey(1.0 / (is_first ? share : 1.0 - share))};
    };
    const auto t = [](int n) { return std::pow(0.5, n) + 1e-6 * std::pow(0.99, n); };
    const Estimates found = probe(scene, both, Technique::bsdf, {.samples = 64, .bounces = 20, .seed = seed});
    for (const int n : {1, 10, 20})
        figures.near(fmt::format("K^{} Le", n), found.terms[static_cast<std::size_t>(n)].mean.r, t(n), 1e-14 * t(n));
    const double exact = std::pow(0.5, 20) + 1e-4 * std::pow(0.99, 21), ratio = t(20) / t(19);
    figures.near("rest over what the ratio predicts", exact / (t(20) * ratio / (1.0 - ratio)), 25.11008731388987, 1e-9);
    const Estimates rest =
        probe(scene, both, Technique::bsdf, {.samples = 8192, .bounces = 20, .rest_probability = 1.0, .seed = seed});
    figures.sampled("sum of K^i Le, i > 20", rest.rest, exact);
}

}  // namespace

Cases stiff_cases() {
    Cases cases;
    for (const double rho : albedos) {
        const auto named = [rho](const char* method) { return fmt::format("stiff/albedo-{:.10g}/{}", rho, method); };
        for (const Sampling& sampling : samplings())
            cases.push_back({named(name_of(sampling.method)), "rho^i, rho^(N+1)/(1 - rho): exact",
                             [=](Figures& figures, std::uint64_t seed) { by_sampling(figures, seed, sampling, rho); }});
        for (const Method& method : {with_fields(method::Patches()), with_fields(method::Matrix()), with_fields(method::Gather())})
            cases.push_back({named(name_of(method)), "rho^i, rho^(N+1)/(1 - rho): exact",
                             [=](Figures& figures, std::uint64_t seed) { by_fields(figures, seed, method, rho); }});
        cases.push_back(
            {named("pilot"), "converges below 1", [=](Figures& figures, std::uint64_t seed) { by_pilot(figures, seed, rho); }});
        cases.push_back({named("solvers"), "1/(1 - rho): exact",
                         [=](Figures& figures, std::uint64_t seed) { by_solvers(figures, seed, rho); }});
    }
    cases.push_back({"stiff/late/twelve-rooms", "LU", chain_of_rooms});
    cases.push_back({"stiff/late/door-ajar", "absorbed = emitted", light_behind_a_door});
    cases.push_back({"stiff/two-rates/walk", "0.5^n + 1e-6 0.99^n: exact", two_furnaces});
    return cases;
}

}  // namespace neumann::known
