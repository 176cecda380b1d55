#include "operators/pictures/pilot.h"

#include "core/base/stopwatch.h"
#include "core/sampling/sampler.h"
#include "operators/walk/walks.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <atomic>
#include <numeric>

namespace neumann {

namespace {

constexpr std::uint64_t pilot_stream = 0x70696c6f74ull;  // another seed than the pictures'
constexpr std::uint64_t batch = 64, largest_batches = 256;
constexpr std::uint64_t enough_rays = 1'000'000;

std::atomic<std::uint64_t> pilots = 0;

}  // namespace

Pilot::Pilot(const Scene& scene, const DirectLightSettings& direct, std::uint64_t seed) {
    ++pilots;
    constexpr std::size_t quantities = bounces + 2;
    const WalkSettings settings{.bounces = bounces, .direct = direct, .rest_probability = 1.0, .give_up = give_up};
    const DirectLightSampler direct_light(scene, direct);
    const Stopwatch watch;

    // Moments of the terms and of the tails Σ_{k>i}, over walks; batches are added in a fixed order.
    struct Moments {
        std::vector<double> sum = std::vector<double>(quantities), square = std::vector<double>(quantities);
        void add(std::size_t q, double x) {
            sum[q] += x;
            square[q] += x * x;
        }
        void add(const Moments& other) {
            for (std::size_t q = 0; q < quantities; ++q) {
                sum[q] += other.sum[q];
                square[q] += other.square[q];
            }
        }
        MeanWithError mean(std::size_t q, double n) const {
            const double mean = sum[q] / n, variance = std::max(square[q] / n - mean * mean, 0.0) / (n - 1.0);
            return {mean, std::sqrt(variance), n - 1.0};
        }
    };
    struct Batch {
        Moments term, tail;
        std::vector<std::uint64_t> rays = std::vector<std::uint64_t>(quantities);
        std::uint64_t given_up = 0;
    };
    Moments term, tail;
    std::vector<std::uint64_t> rays(quantities);
    std::uint64_t all_rays = 0, batches = 0;
    constexpr std::uint64_t together = 8;
    while (batches < largest_batches && all_rays < enough_rays) {
        std::vector<Batch> round(together);
        oneapi::tbb::parallel_for(std::uint64_t{0}, together, [&](std::uint64_t b) {
            std::vector<CameraRay> camera_rays;
            std::vector<double> responses;
            std::vector<Sampler> samplers;
            const Film& film = scene.film;
            for (std::uint64_t i = 0; i < batch; ++i) {
                Sampler& sampler =
                    samplers.emplace_back(seed ^ pilot_stream, static_cast<std::uint32_t>((batches + b) * batch + i));
                sampler.start(0);
                const Vec2 u = sampler.next2();
                const Vec2 position(film.crop_x + u.x * film.crop_width, film.crop_y + u.y * film.crop_height);
                camera_rays.push_back(scene.camera.sample_ray(position, sampler));
                responses.push_back(scene.camera.response(position));
            }
            std::vector<Rgb> sampled(batch * quantities, Rgb(0.0));
            TermSamples result{sampled, round[b].rays};
            Walkers walkers;
            walk(scene, direct_light, settings, camera_rays, samplers, walkers, result, MaterialContinuation());
            for (std::uint64_t i = 0; i < batch; ++i) {
                Rgb* terms = sampled.data() + i * quantities;
                for (std::size_t q = 0; q < quantities; ++q) terms[q] *= responses[i];
                double sum = 0.0;
                for (std::size_t q = quantities; q-- > 1;) {
                    sum += mean_component(terms[q]);
                    round[b].tail.add(q - 1, sum);
                    round[b].term.add(q, mean_component(terms[q]));
                }
                round[b].term.add(0, mean_component(terms[0]));
            }
            round[b].given_up = result.given_up;
        });
        for (const Batch& b : round) {
            term.add(b.term);
            tail.add(b.tail);
            given_up_ += b.given_up;
            for (std::size_t q = 0; q < quantities; ++q) {
                rays[q] += b.rays[q];
                all_rays += b.rays[q];
            }
        }
        batches += together;
    }
    walks_ = batches * batch;
    const auto n = static_cast<double>(walks_);
    for (std::size_t q = 0; q < quantities; ++q) {
        term_.push_back(term.mean(q, n));
        rest_.push_back(tail.mean(q, n));
        rays_.push_back(static_cast<double>(rays[q]) / n);
    }
    seconds_per_ray_ = watch.seconds() / static_cast<double>(std::max<std::uint64_t>(all_rays, 1));
}

std::uint64_t pilots_run() { return pilots; }

double Pilot::seconds_per_walk(int N) const {
    const auto end = rays_.begin() + std::min<std::ptrdiff_t>(N + 1, std::ssize(rays_));
    return seconds_per_ray_ * std::max(std::accumulate(rays_.begin(), end, 0.0), 1.0);
}

MeanWithError Pilot::term(int i) const { return term_[static_cast<std::size_t>(i)]; }

MeanWithError Pilot::rest(int i) const { return rest_[static_cast<std::size_t>(i)]; }

int Pilot::bounces_for_tail(double fraction) const {
    for (int i = 0; i <= bounces; ++i)
        if (rest(i).mean + 2.0 * rest(i).standard_error <= fraction * sum()) return i;
    return -1;
}

double Pilot::rest_probability(int N) const {
    // The pilot's walks have no roulette up to bounce 256. The render's have it beyond N, and survive about as the terms fall.
    const auto term = [&](std::size_t q) { return rest_[q - 1].mean - (q < rest_.size() ? rest_[q].mean : 0.0); };
    const auto first = static_cast<std::size_t>(N) + 1;
    double terms = 0.0, beyond = 0.0;
    for (std::size_t q = 0; q < rays_.size(); ++q) {
        if (q < first)
            terms += rays_[q];
        else
            beyond += rays_[q] * (q < rays_.size() - 1 && term(first) > 0.0 ? std::clamp(term(q) / term(first), 0.0, 1.0) : 1.0);
    }
    return beyond > terms ? terms / beyond : 1.0;
}

}  // namespace neumann
