// Properties of the estimators themselves: the variance of one sample if it is finite, the tail of the samples if it is
// not, and the fall of the error. All samples are independent here.
#include "operators/experiments/known/groups.h"
#include "operators/experiments/known/scene_maker.h"
#include "operators/paths/walk/furnace_walk.h"

#include <fmt/format.h>

namespace neumann::known {

namespace {

// The unit cube with ρ = 1 and an emitting ceiling has K^i Le = g_i at the floor's centre.
constexpr double g1 = 0.23945647046077306, g2 = 0.13875246294508298;

Scene cube() {
    SceneMaker maker;
    const auto faces = room({0, 0, 0}, {1, 1, 1});
    for (std::size_t i = 0; i < 6; ++i) maker.add(faces[i], i == ceiling ? glowing(1.0, 1.0) : matte(1.0));
    return maker.make();
}
ProbeSettings independent(std::uint32_t samples, int bounces, std::uint64_t seed) {
    return {.samples = samples, .bounces = bounces, .sampler = SamplerKind::independent, .seed = seed};
}
StartPicker middle_of_floor(const Scene& scene) { return at(scene, {0.5, 0.5, 0}, {0, 0, 1}); }

// A walk finds the light or not, so its variance is g (1 − g); other variances are from quadrature.
void variances(Figures& figures, std::uint64_t seed) {
    const Scene scene = cube();
    const Estimates by_walk = probe(scene, middle_of_floor(scene), Technique::bsdf, independent(65536, 2, seed));
    figures.sampled("K Le by cosine", by_walk.variance[1], g1 * (1.0 - g1));
    figures.sampled("K^2 Le by cosine", by_walk.variance[2], g2 * (1.0 - g2));
    figures.sampled("K Le by points on the light",
                    probe(scene, middle_of_floor(scene), Technique::light, independent(16384, 1, seed)).variance[1],
                    0.0017405096111192883);
    ProbeSettings uniform = independent(32768, 1, seed);
    uniform.direct = DirectLightSettings{.direct = DirectLight::hemisphere};
    figures.sampled("K Le by uniform directions", probe(scene, middle_of_floor(scene), Technique::mis, uniform).variance[1],
                    0.39080403967926547);
    figures.sampled("K Le by operators",
                    probe(scene, middle_of_floor(scene), Technique::pointwise, independent(65536, 1, seed)).variance[1],
                    g1 * (1.0 - g1));
}

// The variance on a wall at d below the ceiling tends to 1/(24 π d²).
void near_an_edge(Figures& figures, std::uint64_t seed) {
    const Scene scene = cube();
    figures.sampled("0.5 below the light",
                    probe(scene, at(scene, {0, 0.5, 0.5}, {1, 0, 0}), Technique::light, independent(65536, 1, seed)).variance[1],
                    0.00846772891327989);
}

// A tail of index 1.5 is recognised as one of infinite variance in 96% of such runs (1.5 (1 + 3.1/√250) < 2 within 1.8
// standard errors): fewer than half of six runs recognise it once in 40,000 times.
void says_infinite(Figures& figures, const std::string& quantity, const Scene& scene, const StartPicker& from, std::size_t term,
                   std::uint64_t seed) {
    double runs = 0.0;
    for (std::uint64_t run = 0; run < 6; ++run) {
        const Estimates found = probe(scene, from, Technique::light, independent(16384, 2, seed + (run << 32)));
        const auto tail = tail_index(found.largest[term]);
        runs += tail && tail->variance_is_infinite();
    }
    figures.at_least(quantity + ": infinite variance in runs of 6", runs, 3.0);
}

// Both points are random on squares that share an edge: P(X > x) = 0.0217927 x^−1.5, to 2% from x = 10 on. Counts are
// Poisson numbers.
void shared_edge(Figures& figures, std::uint64_t seed) {
    SceneMaker maker;
    const std::uint32_t receiver = maker.add(parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), matte(1.0));
    maker.add(parallelogram({0, 0, 0}, {0, 1, 0}, {0, 0, 1}), lamp(1.0));
    const Scene scene = maker.make();
    const Estimates found = probe(scene, anywhere_on(scene, receiver), Technique::light, independent(65536, 1, seed));
    const auto n = static_cast<double>(found.samples);
    const std::vector<double> largest = found.largest[1].sorted();
    for (const double x : {30.0, 60.0, 120.0}) {
        const double expected = n * 0.02179270037342922 * std::pow(x, -1.5);
        double count = 0.0;
        for (const double sample : largest) count += sample > x;
        figures.near(fmt::format("samples above {:g}", x), count, expected, z_limit * std::sqrt(expected) + 0.02 * expected);
    }
    const auto tail = tail_index(found.largest[1]);
    figures.near("tail index", tail ? tail->alpha : 0.0, 1.5, z_limit * 1.5 / std::sqrt(1000.0));
    says_infinite(figures, "K Le", scene, anywhere_on(scene, receiver), 1, seed);
}

// 95% intervals from 1000 samples between two squares at right angles. With infinite variance they hold the truth in
// 75% of cases (from 4000 repetitions of another program) and otherwise lie below it; if directions find the light or
// not, in 95%. An interval from the means of 64 batches is as good as one from all samples, because the largest sample
// decides both; 5% is allowed for the remaining difference.
void coverage(Figures& figures, std::uint64_t seed) {
    constexpr double form_factor = 0.20004377607540315, t = 1.998, repetitions = 400;
    SceneMaker maker;
    const std::uint32_t receiver = maker.add(parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), matte(1.0));
    maker.add(parallelogram({0, 0, 0}, {0, 1, 0}, {0, 0, 1}), lamp(1.0));
    const Scene scene = maker.make();
    for (const Technique technique : {Technique::light, Technique::bsdf}) {
        double covered = 0.0, below = 0.0;
        for (std::uint64_t k = 0; k < repetitions; ++k) {
            const Statistic found =
                probe(scene, anywhere_on(scene, receiver), technique, independent(16, 1, seed + (k << 32))).terms[1];
            const double error = found.mean.r - form_factor;
            covered += std::abs(error) <= t * found.standard_error.r;
            below += error < -t * found.standard_error.r;
        }
        const double expected = technique == Technique::light ? 0.75 : 0.95;
        figures.near(fmt::format("intervals that hold the truth, {}", short_name(technique)), covered / repetitions, expected,
                     z_limit * std::sqrt(expected * (1.0 - expected) / repetitions) + (technique == Technique::light ? 0.05 : 0.0));
        if (technique == Technique::light) figures.at_least("of the others, below", below / (repetitions - covered), 0.95);
    }
}

// The ceiling touches the walls, so from K² on light sampling has infinite variance. The alarm must be raised there and
// nowhere else. Means of infinite variance have no interval and are not compared.
void touching_light(Figures& figures, std::uint64_t seed) {
    const Scene scene = cube();
    const auto upper = [](const LargestSamples& largest) {
        const auto tail = tail_index(largest);
        return tail ? tail->upper : 1e9;
    };
    const Estimates by_light = probe(scene, middle_of_floor(scene), Technique::light, independent(16384, 2, seed));
    says_infinite(figures, "K^2 Le by points", scene, middle_of_floor(scene), 2, seed);
    figures.at_least("K Le by points: tail index", upper(by_light.largest[1]), 2.0);
    for (const Technique technique : {Technique::mis, Technique::bsdf}) {
        const Estimates found = probe(scene, middle_of_floor(scene), technique, independent(16384, 2, seed));
        figures.at_least(fmt::format("K^2 Le by {}: tail index", short_name(technique)), upper(found.largest[2]), 2.0);
    }
    // The value is from 4e6 paths of another program; its error follows from ours by the numbers of paths.
    ProbeSettings balance = independent(65536, 2, seed);
    balance.direct = DirectLightSettings{.direct = DirectLight::mis, .heuristic = Heuristic::balance};
    const Estimates mixed = probe(scene, middle_of_floor(scene), Technique::mis, balance);
    const double error = mixed.variance[2].standard_error.r;
    figures.sampled("K^2 Le by MIS, balance", mixed.terms[2], g2);
    figures.near("its variance", mixed.variance[2].mean.r, 0.03543286681558638,
                 z_limit * error * std::sqrt(1.0 + static_cast<double>(mixed.samples) / 4e6));
}

// ⟨(mean of N − truth)²⟩ of 64 replicates falls like 1/N: its logarithm has the slope −1 with a deviation of 0.030.
void slope(Figures& figures, std::uint64_t seed) {
    const Scene scene = cube();
    double x1 = 0.0, y1 = 0.0, xx = 0.0, xy = 0.0;
    constexpr int sizes = 6;
    for (int k = 0; k < sizes; ++k) {
        const auto samples = static_cast<std::uint32_t>(64) << (2 * k);
        const Statistic found =
            probe(scene, middle_of_floor(scene), Technique::bsdf, independent(samples, 1, seed + static_cast<std::uint64_t>(k)))
                .terms[1];
        const double n = batch_count, spread = found.standard_error.r * found.standard_error.r * (n - 1.0),
                     mse = spread + std::pow(found.mean.r - g1, 2), x = std::log(static_cast<double>(samples)), y = std::log(mse);
        x1 += x / sizes;
        y1 += y / sizes;
        xx += x * x / sizes;
        xy += x * y / sizes;
    }
    const double of_squares = sizes * (xx - x1 * x1), deviation = std::sqrt(2.0 / batch_count / of_squares);
    figures.near("standard deviation of the slope", deviation, 0.030, 0.001);
    figures.near("slope of the mean squared error", (xy - x1 * y1) / (xx - x1 * x1), -1.0, z_limit * deviation);
}

// A furnace of albedo ρ and survival q: 1/(1 − q) vertices, the sum of (ρ/q)^k, a variance that is finite if and only
// if ρ² < q. `variance`: of the sum.
void roulette(Figures& figures, std::uint64_t seed, double rho, double q, double variance) {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, glowing(rho, 1.0));
    const Scene scene = maker.make();
    const Roulette fixed{Roulette::Kind::fixed, q};
    const FurnaceWalk known = furnace_walk(fixed, rho, 0);
    const bool finite = rho * rho < q;
    figures.near("vertices, by formula", known.vertices, 1.0 / (1.0 - q), 1e-12 / (1.0 - q));
    ProbeSettings settings = independent(16384, 0, seed);
    settings.rest_probability = 1.0;
    settings.roulette = fixed;
    const Estimates found = probe(scene, at(scene, {0, 0, 1}, {0, 0, -1}), Technique::bsdf, settings);
    figures.sampled("vertices", {Rgb(found.rays_mean), Rgb(found.rays_error)}, 1.0 / (1.0 - q));
    if (finite) {
        const double mean = 1.0 / (1.0 - rho);
        figures.near("variance, by formula", known.second_moment - mean * mean, variance, 1e-9 * variance);
        figures.sampled("sum of K^i Le, i > 0", found.rest, mean - 1.0);
        // Fourth moments are large, or infinite where ρ⁴ ≥ q³.
        if (std::pow(rho, 4) < 0.9 * q * q * q)
            figures.near("variance", found.rest_variance.mean.r, variance, z_limit * found.rest_variance.standard_error.r);
    } else {
        figures.holds("second moment is infinite, by formula", std::isinf(known.second_moment));
        // P(X > x) ~ x^−α, α = ln q/ln(q/ρ), but X takes only values that are a factor of ρ/q apart. Hill's estimate is then
        // between (1 − q)/ln(ρ/q), if none of the kept samples equals the smallest, and 1/q of that, if as many as possible do.
        const auto tail = tail_index(found.largest.back());
        const double step = std::log(rho / q), lowest = (1.0 - q) / step, highest = lowest / q;
        figures.near("tail index, of steps", tail ? tail->alpha : 0.0, 0.5 * (lowest + highest),
                     0.5 * (highest - lowest) + z_limit * highest / std::sqrt(1000.0));
        // A thousand samples do not distinguish an index near 2 from 2.
        if (highest < 1.5) figures.at_most("its upper bound", tail ? tail->upper : 1e9, 2.0);
    }
}

// With roulette by albedo, survival is the albedo itself: the variance of Σ_{k≥1} is ρ/(1 − ρ)².
void roulette_by_albedo(Figures& figures, std::uint64_t seed, double rho) {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, glowing(rho, 1.0));
    const Scene scene = maker.make();
    ProbeSettings settings = independent(rho > 0.95 ? 8192 : 16384, 0, seed);
    settings.rest_probability = 1.0;
    const Estimates found = probe(scene, at(scene, {0, 0, -1}, {0, 0, 1}), Technique::bsdf, settings);
    figures.sampled("rays of a walk", {Rgb(found.rays_mean), Rgb(found.rays_error)}, 1.0 / (1.0 - rho));
    figures.sampled("sum of K^i Le, i > 0", found.rest, rho / (1.0 - rho));
    const double variance = rho / std::pow(1.0 - rho, 2);
    // A geometric distribution has a kurtosis slightly above 9, so that 0.2% would take millions of walks.
    figures.near("its variance", found.rest_variance.mean.r, variance, z_limit * found.rest_variance.standard_error.r);
}

}  // namespace

Cases monte_carlo_cases() {
    Cases cases;
    cases.push_back({"monte-carlo/variance/floor-centre", "g(1 - g): exact; quadrature", variances});
    cases.push_back({"monte-carlo/variance/near-an-edge", "quadrature, 1e-12", near_an_edge});
    cases.push_back({"monte-carlo/infinite/shared-edge", "0.0217927 x^-1.5 asymptotically, 2%", shared_edge});
    cases.push_back({"monte-carlo/infinite/touching-light", "tail index 1.5; 4e6 paths elsewhere", touching_light});
    cases.push_back({"monte-carlo/infinite/coverage", "4000 repetitions elsewhere, 5%", coverage});
    cases.push_back({"monte-carlo/slope", "1/N", slope});
    for (const auto& [rho, q, variance] :
         {std::tuple{0.5, 0.7, 2.0 / 3.0}, {0.9, 0.9, 90.0}, {0.9, 0.95, 28.92857142857146}, {0.9, 0.8, 0.0}, {0.99, 0.9, 0.0}})
        cases.push_back(
            {fmt::format("monte-carlo/roulette/albedo-{:g}-survival-{:g}", rho, q), "rho^2 < q or infinite; 1/(1 - q)",
             [rho = rho, q = q, variance = variance](Figures& f, std::uint64_t seed) { roulette(f, seed, rho, q, variance); }});
    for (const double rho : {0.5, 0.9, 0.99})
        cases.push_back({fmt::format("monte-carlo/roulette/by-albedo-{:g}", rho), "rho/(1 - rho)^2: exact",
                         [rho](Figures& f, std::uint64_t seed) { roulette_by_albedo(f, seed, rho); }});
    return cases;
}

}  // namespace neumann::known
