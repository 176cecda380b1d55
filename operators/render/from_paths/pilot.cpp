#include "operators/render/from_paths/pilot.h"

#include "core/base/stopwatch.h"
#include "core/sampling/sampler.h"
#include "operators/paths/walk/walks.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <atomic>
#include <numeric>

namespace neumann {

namespace {

constexpr std::uint64_t pilot_stream = 0x70696c6f74ull;  // differs from the seed of the pictures
constexpr std::uint64_t batch = 64, together = 8, largest_batches = 256;
// Numbers of rays after which a pilot ends. It needs more with most_bounces: walks are not ended by roulette up to the
// last term, and in a closed room most rays are in late bounces.
constexpr std::uint64_t enough_rays = 250'000, enough_rays_of_most = 1'000'000;
// The rest beyond few_bounces is small if it is at most this part of the wanted tail.
constexpr double small_part = 0.1;

std::atomic<std::uint64_t> pilots = 0;

}  // namespace

// The walks up to a bounce N. Their quantities are the terms 0 … N, and the rest as the last.
struct Pilot::Walks {
    struct Moments {
        std::vector<double> sum, square;
        explicit Moments(std::size_t quantities) : sum(quantities), square(quantities) {}
        void add(std::size_t q, double x) {
            sum[q] += x;
            square[q] += x * x;
        }
        void add(const Moments& other) {
            for (std::size_t q = 0; q < sum.size(); ++q) {
                sum[q] += other.sum[q];
                square[q] += other.square[q];
            }
        }
        MeanWithError mean(std::size_t q, double n) const {
            const double mean = sum[q] / n, variance = std::max(square[q] / n - mean * mean, 0.0) / (n - 1.0);
            return {mean, std::sqrt(variance), n - 1.0};
        }
    };

    explicit Walks(int N)
        : bounces(N), quantities(static_cast<std::size_t>(N) + 2), term(quantities), tail(quantities), rays(quantities) {}

    int bounces;
    std::size_t quantities;
    Moments term, tail;  // tail: Σ_{k>i}
    std::vector<std::uint64_t> rays;
    std::uint64_t given_up = 0, batches = 0;

    std::uint64_t all_rays() const { return std::accumulate(rays.begin(), rays.end(), std::uint64_t{0}); }
    double count() const { return static_cast<double>(batches * batch); }

    void add(const Walks& other) {
        term.add(other.term);
        tail.add(other.tail);
        for (std::size_t q = 0; q < quantities; ++q) rays[q] += other.rays[q];
        given_up += other.given_up;
        batches += other.batches;
    }

    void sample_batch(const Scene& scene, const DirectLightSampler& direct_light, const DirectLightSettings& direct,
                      std::uint64_t seed, std::uint64_t number) {
        const WalkSettings settings{.bounces = bounces, .direct = direct, .rest_probability = 1.0, .give_up = give_up};
        std::vector<CameraRay> camera_rays;
        std::vector<double> responses;
        std::vector<Sampler> samplers;
        const Film& film = scene.film;
        for (std::uint64_t i = 0; i < batch; ++i) {
            Sampler& sampler = samplers.emplace_back(seed ^ pilot_stream, static_cast<std::uint32_t>(number * batch + i));
            sampler.start(0);
            const Vec2 u = sampler.next2();
            const Vec2 position(film.crop_x + u.x * film.crop_width, film.crop_y + u.y * film.crop_height);
            camera_rays.push_back(scene.camera.sample_ray(position, sampler));
            responses.push_back(scene.camera.response(position));
        }
        std::vector<Rgb> sampled(batch * quantities, Rgb(0.0));
        TermSamples result{sampled, rays};
        Walkers walkers;
        walk(scene, direct_light, settings, camera_rays, samplers, walkers, result, MaterialContinuation());
        for (std::uint64_t i = 0; i < batch; ++i) {
            Rgb* terms = sampled.data() + i * quantities;
            for (std::size_t q = 0; q < quantities; ++q) terms[q] *= responses[i];
            double sum = 0.0;
            for (std::size_t q = quantities; q-- > 1;) {
                sum += mean_component(terms[q]);
                tail.add(q - 1, sum);
                term.add(q, mean_component(terms[q]));
            }
            term.add(0, mean_component(terms[0]));
        }
        given_up = result.given_up;
        batches = 1;
    }
};

Pilot::Pilot(const Scene& scene, const DirectLightSettings& direct, std::uint64_t seed, int wanted, double tail) {
    ++pilots;
    const DirectLightSampler direct_light(scene, direct);
    // Samples walks up to this number of bounces; false if the rest beyond them is too large.
    const auto sample = [&](int bounces, std::uint64_t enough) {
        const Stopwatch watch;
        Walks all(bounces);
        do {
            std::vector<Walks> round(together, Walks(bounces));
            oneapi::tbb::parallel_for(std::uint64_t{0}, together, [&](std::uint64_t b) {
                round[b].sample_batch(scene, direct_light, direct, seed, all.batches + b);
            });
            for (const Walks& walks : round) all.add(walks);  // in a fixed order
            take(all);
            if (bounces < most_bounces && upper_rest(bounces) > small_part * tail * sum()) return false;
        } while (all.batches < largest_batches && all.all_rays() < enough);
        seconds_per_ray_ = watch.seconds() / static_cast<double>(std::max<std::uint64_t>(all.all_rays(), 1));
        return true;
    };
    if (wanted > few_bounces || !sample(few_bounces, enough_rays)) sample(most_bounces, enough_rays_of_most);
}

void Pilot::take(const Walks& walks) {
    const double n = walks.count();
    walks_ = walks.batches * batch;
    given_up_ = walks.given_up;
    term_.clear();
    rest_.clear();
    rays_.clear();
    for (std::size_t q = 0; q < walks.quantities; ++q) {
        term_.push_back(walks.term.mean(q, n));
        rest_.push_back(walks.tail.mean(q, n));
        rays_.push_back(static_cast<double>(walks.rays[q]) / n);
    }
}

std::uint64_t pilots_run() { return pilots; }

double Pilot::seconds_per_walk(int N) const {
    const auto end = rays_.begin() + std::min<std::ptrdiff_t>(N + 1, std::ssize(rays_));
    return seconds_per_ray_ * std::max(std::accumulate(rays_.begin(), end, 0.0), 1.0);
}

MeanWithError Pilot::term(int i) const { return term_[static_cast<std::size_t>(i)]; }

MeanWithError Pilot::rest(int i) const { return rest_[static_cast<std::size_t>(i)]; }

double Pilot::upper_rest(int i) const { return rest(i).mean + 2.0 * rest(i).standard_error; }

int Pilot::bounces_for_tail(double fraction) const {
    for (int i = 0; i <= bounces(); ++i)
        if (upper_rest(i) <= fraction * sum()) return i;
    return -1;
}

double Pilot::rest_probability(int N) const {
    // Unlike the pilot's walks, the render's have roulette beyond N, and their number falls about as the terms do.
    const auto term = [&](std::size_t q) { return rest_[q - 1].mean - (q < rest_.size() ? rest_[q].mean : 0.0); };
    const auto first = static_cast<std::size_t>(std::min(N, bounces())) + 1, last = rays_.size() - 1;
    // As many walks go on beyond the last term as reach it.
    const auto survival = [&](std::size_t q) {
        const std::size_t of = std::min(q, last - 1);
        return of >= first && term(first) > 0.0 ? std::clamp(term(of) / term(first), 0.0, 1.0) : 1.0;
    };
    double terms = 0.0, beyond = 0.0;
    for (std::size_t q = 0; q <= last; ++q) {
        if (q < first)
            terms += rays_[q];
        else
            beyond += rays_[q] * survival(q);
    }
    return beyond > terms ? terms / beyond : 1.0;
}

}  // namespace neumann
