#include "operators/render/from_paths/mixture_pilot.h"

#include "operators/render/from_paths/allocation.h"
#include "operators/render/from_paths/best_mixture.h"
#include "operators/render/from_paths/mixture_trial.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <numeric>

namespace neumann {

namespace {

constexpr std::uint32_t first_replicates = 2, all_replicates = 8;
constexpr double all_samples = 1 << 18;  // of a method, in all pixels together
// The side of a block in pixels of the pilot's film.
constexpr std::uint32_t pilot_block = 2;
// This part of a block's variance is the mean over the block and those around it.
constexpr double from_around = 0.1;
// At least this part of a method's variance is believed to be where the light is.
constexpr double least_by_light = 0.1;
// A larger part is, if the variance fills less than 1/few of the lit blocks.
constexpr double few = 4.0;
// Any method is believed to have at least this part of the largest variance of a method.
constexpr double least_variance = 1e-4;
// A method has missed light if it has less than another by this many standard errors. It would have met the missed
// light with at most met_at_most samples, with 95% confidence (the rule of three).
constexpr double missed = 3.0, met_at_most = 3.0;
// After the first replicates a method is left out if its part of the work would be smaller than share_to_go_on, or if
// the minimised error without it would be larger by a factor below gain_of_part: a mixture loses part of its gain
// because each method has fewer samples to stratify.
constexpr double share_to_go_on = 0.01, gain_of_part = 1.3;
// A pixel has at most 2^most_powers times the mixture's mean number of samples of a method.
constexpr int most_powers = 4;

struct Contender {
    const MixtureCandidate* candidate;
    std::unique_ptr<MixtureTrial> trial;
};
using Contenders = std::vector<Contender>;

struct Grid {
    PixelBlocks blocks;
    std::uint32_t width, height;
    std::size_t of(std::uint32_t pixel) const { return blocks.of(pixel, width, height); }
};

double sum_of(const Rgb& x) { return x.r + x.g + x.b; }
double sum_of(const std::vector<double>& all) { return std::accumulate(all.begin(), all.end(), 0.0); }
// The effective number of entries that make up the sum.
double number_of(const std::vector<double>& all) {
    const double squares = std::inner_product(all.begin(), all.end(), all.begin(), 0.0), sum = sum_of(all);
    return squares > 0.0 ? sum * sum / squares : 0.0;
}

// The variance of a sample for each method and block, summed over pixels and channels; and the bounce's squared size.
struct BounceVariances {
    std::vector<std::vector<double>> of;
    double square = 0.0;
};

// A method that has not met the rare paths of a bounce sees neither their light nor their variance. So each method is
// compared with the one that is surest of most light: light that it lacks must come in samples so rare and so large
// that it met hardly any. And variance from a few samples in a few blocks might as well have been in other lit blocks.
BounceVariances variances_of(const Contenders& all, std::size_t bounce, const Grid& grid) {
    const std::size_t B = grid.blocks.count();
    const MixtureTrial& best =
        *std::ranges::max_element(all, {}, [&](const Contender& c) { return c.trial->sure_mean(bounce); })->trial;
    BounceVariances found;
    std::vector<double> light(B, 0.0);
    double of_best = 0.0;
    for (std::uint32_t pixel = 0; pixel < best.pixels(); ++pixel) {
        const Rgb mean = best.mean(pixel, bounce);
        light[grid.of(pixel)] += sum_of(mean);
        of_best += sum_of(best.variance(pixel, bounce));
        found.square += glm::dot(mean, mean);
    }
    found.square -= of_best / best.samples();
    const double all_light = sum_of(light);
    for (const Contender& contender : all) {
        const MixtureTrial& trial = *contender.trial;
        std::vector<double> own(B, 0.0), variance(B);
        double mean = 0.0;
        for (std::uint32_t pixel = 0; pixel < trial.pixels(); ++pixel) {
            own[grid.of(pixel)] += sum_of(trial.variance(pixel, bounce));
            mean += sum_of(trial.mean(pixel, bounce));
        }
        const double lacks = all_light - mean, error = std::sqrt((sum_of(own) + of_best) / trial.samples());
        const double of_missed = lacks > missed * error ? trial.samples() / met_at_most * lacks * lacks : 0.0;
        const double spread = std::min(few * number_of(own) / number_of(light), 1.0) * (1.0 - least_by_light);
        for (std::size_t b = 0; b < B; ++b) {
            double around = 0.0, number = 0.0;
            grid.blocks.for_neighbourhood(b, [&](std::size_t other) {
                around += own[other];
                number += 1.0;
            });
            const double nearby = (1.0 - from_around) * own[b] + from_around * around / number;
            variance[b] = spread * nearby + ((1.0 - spread) * sum_of(own) + of_missed) * light[b] / all_light;
        }
        found.of.push_back(std::move(variance));
    }
    double largest = 0.0;
    for (const std::vector<double>& of : found.of) largest = std::max(largest, sum_of(of));
    for (std::vector<double>& of : found.of)
        for (double& v : of) v = std::max(v, least_variance * largest / static_cast<double>(B));
    return found;
}

struct Measured {
    MixtureCosts costs;
    std::vector<std::size_t> bounces;  // the bounces with light and variance
};

// If `of` is a single bounce, of this one.
Measured measure(const Contenders& all, double budget, const Grid& grid, LeastError of) {
    const std::size_t M = all.size(), B = grid.blocks.count();
    Measured found{{M, 0, B, {}, std::vector<double>(M * B, 0.0), {}, budget, {}}, {}};
    for (const Contender& contender : all) found.costs.even.push_back(contender.candidate->settings.method->has_even_samples());
    std::vector<std::vector<double>> variances(M);
    for (std::size_t bounce = 0; bounce < all.front().trial->terms(); ++bounce) {
        if (of.bounce && bounce != static_cast<std::size_t>(*of.bounce)) continue;
        const BounceVariances bounce_variances = variances_of(all, bounce, grid);
        double sum = 0.0;
        for (const std::vector<double>& of_method : bounce_variances.of) sum += sum_of(of_method);
        if (!(bounce_variances.square > 0.0) || !(sum > 0.0) || !std::isfinite(sum)) continue;
        found.bounces.push_back(bounce);
        found.costs.sizes.push_back(bounce_variances.square);
        for (std::size_t m = 0; m < M; ++m)
            for (const double v : bounce_variances.of[m]) variances[m].push_back(v / bounce_variances.square);
    }
    MixtureCosts& costs = found.costs;
    for (const std::vector<double>& of : variances) costs.variances.insert(costs.variances.end(), of.begin(), of.end());
    costs.errors = found.bounces.size();
    const double size = sum_of(costs.sizes);
    for (double& square : costs.sizes) square /= size;
    for (std::size_t m = 0; m < M; ++m)
        for (std::uint32_t pixel = 0; pixel < all[m].trial->pixels(); ++pixel)
            costs.costs[m * B + grid.of(pixel)] += all[m].candidate->price * all[m].trial->rays(pixel);
    return found;
}

// The methods that are worth it, and their best numbers of samples.
struct Choice {
    Contenders all;
    Measured measured;
    std::vector<double> numbers;
    std::uint64_t rays = 0;  // of all pilots

    void leave_out(std::size_t m) { all.erase(all.begin() + static_cast<std::ptrdiff_t>(m)); }
};

std::vector<double> best_numbers(const MixtureCosts& costs, LeastError least) {
    return costs.errors > 0 ? best_mixture(costs, least) : std::vector<double>(costs.methods * costs.blocks, 1.0);
}

Choice choose(Contenders contenders, double budget, const Grid& grid, LeastError least, const Watch& watch) {
    Choice chosen{std::move(contenders), {}, {}, 0};
    Contenders& all = chosen.all;
    const auto go_on = [&](std::uint32_t replicates) {
        for (Contender& contender : all) {
            const std::uint64_t before = contender.trial->rays();
            contender.trial->go_on(replicates, watch);
            chosen.rays += contender.trial->rays() - before;
        }
    };
    go_on(first_replicates);
    const MixtureCosts at_first = measure(all, budget, grid, least).costs;
    const std::vector<double> shares = shares_of(at_first, best_numbers(at_first, least));
    for (std::size_t m = all.size(); m-- > 0;)
        if (shares[m] < share_to_go_on) chosen.leave_out(m);
    go_on(all_replicates - first_replicates);

    chosen.measured = measure(all, budget, grid, least);
    MixtureCosts& costs = chosen.measured.costs;
    for (;;) {
        chosen.numbers = best_numbers(costs, least);
        if (all.size() == 1 || costs.errors == 0) return chosen;
        std::vector<double> without_it;
        for (std::size_t m = 0; m < all.size(); ++m) {
            const MixtureCosts others = without(costs, m);
            without_it.push_back(least_of(others, best_mixture(others, least), least));
        }
        const auto needed_least = std::ranges::min_element(without_it);
        if (*needed_least >= gain_of_part * least_of(costs, chosen.numbers, least)) return chosen;
        const auto out = static_cast<std::size_t>(needed_least - without_it.begin());
        costs = without(costs, out);
        chosen.leave_out(out);
    }
}

// The exponents for each method and block; each block has samples of some method.
std::vector<std::int8_t> exponents_of(const Choice& chosen) {
    const MixtureCosts& costs = chosen.measured.costs;
    const std::vector<double>& numbers = chosen.numbers;
    std::vector<std::int8_t> exponents = as_powers(numbers, costs.costs, costs.budget, most_powers, Below::none);
    for (std::size_t b = 0; b < costs.blocks; ++b) {
        std::size_t most = b;
        for (std::size_t i = b; i < exponents.size(); i += costs.blocks)
            if (numbers[i] > numbers[most]) most = i;
        if (exponents[most] == Allocation::none) exponents[most] = -most_powers;
    }
    for (std::size_t i = 0; i < exponents.size(); ++i)
        if (costs.even[i / costs.blocks] && exponents[i] == Allocation::none) exponents[i] = -most_powers;
    return exponents;
}

// The weights of all bounces; a bounce without variance is weighted by the numbers of samples.
std::vector<double> weights_of_bounces(const Choice& chosen, const std::vector<double>& numbers, std::size_t bounces) {
    const MixtureCosts& costs = chosen.measured.costs;
    const std::vector<double> known = weights_of(costs, numbers);
    std::vector<double> of_block(costs.blocks, 0.0), weights;
    for (std::size_t i = 0; i < numbers.size(); ++i) of_block[i % costs.blocks] += numbers[i];
    for (std::size_t m = 0; m < costs.methods; ++m)
        for (std::size_t bounce = 0; bounce < bounces; ++bounce) {
            const auto k =
                static_cast<std::size_t>(std::ranges::find(chosen.measured.bounces, bounce) - chosen.measured.bounces.begin());
            for (std::size_t b = 0; b < costs.blocks; ++b)
                weights.push_back(k < costs.errors ? known[(m * costs.errors + k) * costs.blocks + b]
                                                   : numbers[m * costs.blocks + b] / of_block[b]);
        }
    return weights;
}

}  // namespace

Mixture mix(const Scene& scene, const Scene& view, const std::vector<MixtureCandidate>& candidates, LeastError least,
            const Watch& watch) {
    const auto grid_of = [](const Film& film, const PixelBlocks& blocks) {
        return Grid{blocks, static_cast<std::uint32_t>(film.crop_width), static_cast<std::uint32_t>(film.crop_height)};
    };
    Grid small = grid_of(view.film, {});
    small.blocks = {(small.width + pilot_block - 1) / pilot_block, (small.height + pilot_block - 1) / pilot_block};
    const Grid large = grid_of(scene.film, small.blocks);
    const std::size_t B = small.blocks.count();

    const double each = all_samples / (all_replicates * static_cast<double>(small.width) * small.height);
    const std::uint32_t size = std::bit_floor(static_cast<std::uint32_t>(std::max(each, 1.0)));
    Contenders contenders;
    for (const MixtureCandidate& candidate : candidates) {
        SamplingSettings settings = candidate.settings;
        // The light that shared points leave to a pixel depends on the number of points, not on that of pixels.
        settings.pixels_of_shared = large.width * large.height;
        contenders.push_back({&candidate, std::make_unique<MixtureTrial>(view, settings, size, watch)});
    }
    double budget = 0.0;
    const MixtureTrial& first = *contenders.front().trial;
    for (std::uint32_t pixel = 0; pixel < first.pixels(); ++pixel) budget += candidates.front().price * first.rays(pixel);

    std::uint64_t rays = 0;
    for (const Contender& contender : contenders) rays += contender.trial->rays();
    const Choice chosen = choose(std::move(contenders), budget, small, least, watch);
    Mixture mixture;
    mixture.blocks = small.blocks;
    mixture.bounces = chosen.all.front().trial->terms();
    mixture.rays = rays + chosen.rays;
    if (chosen.all.size() == 1) {
        const auto& [name, own, price] = *chosen.all.front().candidate;
        mixture.weights.assign(mixture.bounces * B, 1.0);
        mixture.parts.push_back({name, own.method, own.walk.left_out});
        if (!own.method->has_even_samples()) mixture.parts.front().allocation = own.method->allocate(scene, own, least, watch);
        if (const auto& allocation = mixture.parts.front().allocation) mixture.rays += allocation->rays;
        return mixture;
    }
    const std::vector<std::int8_t> exponents = exponents_of(chosen);
    std::vector<double> numbers;
    for (const std::int8_t k : exponents) numbers.push_back(Allocation::times(k));
    mixture.weights = weights_of_bounces(chosen, numbers, mixture.bounces);
    const std::vector<double> shares = shares_of(chosen.measured.costs, numbers);
    for (std::size_t m = 0; m < chosen.all.size(); ++m) {
        const auto& [name, own, price] = *chosen.all[m].candidate;
        mixture.parts.push_back({name, own.method, own.walk.left_out});
        mixture.parts.back().share = shares[m];
        mixture.parts.back().exponent = exponents[m * B];
        if (own.method->has_even_samples()) continue;
        Allocation allocation{std::vector<std::int8_t>(std::size_t{large.width} * large.height), 0};
        for (std::uint32_t pixel = 0; pixel < large.width * large.height; ++pixel)
            allocation.exponents[pixel] = exponents[m * B + large.of(pixel)];
        mixture.parts.back().allocation = std::make_shared<const Allocation>(std::move(allocation));
    }
    return mixture;
}

}  // namespace neumann
