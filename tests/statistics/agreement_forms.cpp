// One K, four ways to write it (Dutré): exitant or incident radiance, R as an integral over directions or over surfaces; and the
// walk as a fifth. All have to say the same of the same places in the Cornell box.
#include "core/reader/read_scene.h"
#include "core/sampling/sampler.h"
#include "operators/algebra/neumann_series.h"
#include "operators/pointwise/emission.h"
#include "operators/pointwise/reflection.h"
#include "operators/pointwise/surface_reflection.h"
#include "operators/pointwise/transport.h"
#include "operators/render/from_paths/picture_sampler.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

namespace neumann::agreement_forms_test {

using T = TransportOperator;
using R = ReflectionOperator;
using R_A = SurfaceReflectionOperator;

// The types say which products there are.
template <class A, class B>
concept Multiply = requires(A a, B b) {
    a* b;
};
static_assert(Multiply<R, T> && Multiply<T, R> && Multiply<R_A, T> && Multiply<T, R_A>);
static_assert(!Multiply<T, T> && !Multiply<R, R> && !Multiply<R_A, R_A> && !Multiply<R, R_A> && !Multiply<R_A, R>);
static_assert(Multiply<Product<R, T>, Product<R_A, T>> && Multiply<T, Product<R, T>> && Multiply<Product<R, T>, R>);
static_assert(!Multiply<Product<R, T>, T> && !Multiply<R, Product<R, T>>);
static_assert(std::same_as<Product<R, T>::Domain, ExitantField> && std::same_as<Product<R, T>::Range, ExitantField>);
static_assert(std::same_as<Product<T, R>::Domain, IncidentField> && std::same_as<Product<T, R>::Range, IncidentField>);
// A series needs a map of one kind of field to itself, and a start of that kind.
template <class Op>
concept HasSeries = requires {
    typename NeumannSeries<Op>;
};
static_assert(HasSeries<Product<R, T>> && HasSeries<Product<T, R>> && !HasSeries<R> && !HasSeries<T>);
static_assert(!std::constructible_from<NeumannSeries<Product<R, T>>, Product<R, T>, IncidentField>);

// Places on the film, from 0 to 1 in both directions, that see the middle of something.
struct FilmPosition {
    const char* name;
    double x, y;
};
constexpr FilmPosition places[] = {{"floor", 0.25, 0.92},
                                   {"back wall", 0.35, 0.30},
                                   {"left wall", 0.08, 0.45},
                                   {"right wall", 0.92, 0.50},
                                   {"top of the short block", 0.633, 0.656},
                                   {"back wall above the short block", 0.62, 0.50}};

// The film is so large that 8×8 of its pixels are one place.
constexpr int film_size = 1 << 24, crop = 8;
Scene cornell_box(const FilmPosition& place) {
    SceneParts parts = read_scene_parts(SCENES "/cornell-box/cornell-box.xml");
    parts.film.width = parts.film.height = film_size;
    parts.film.crop_x = static_cast<int>(place.x * film_size) - crop / 2;
    parts.film.crop_y = static_cast<int>(place.y * film_size) - crop / 2;
    parts.film.crop_width = parts.film.crop_height = crop;
    return make_scene(std::move(parts));
}

struct Mean {
    Rgb mean{0.0}, error{0.0};
};
constexpr int batches = 64;
Mean mean_of(const std::vector<Rgb>& values) {
    const auto n = static_cast<double>(values.size());
    Mean m;
    for (const Rgb& v : values) m.mean += v / n;
    for (const Rgb& v : values) m.error += (v - m.mean) * (v - m.mean);
    m.error = glm::sqrt(m.error / (n * (n - 1.0)));
    return m;
}

struct Independent : Random {
    Independent(std::uint64_t seed, std::uint32_t batch) : sampler(seed, batch) {}
    double next() override { return sampler.next(); }
    Sampler sampler;
};

// K^0 Le … K^N Le, as `ask` answers, from `samples` samples a batch.
template <class Ask>
std::vector<Mean> estimate(int bounces, std::uint64_t seed, int samples, const Ask& ask) {
    const auto terms = static_cast<std::size_t>(bounces) + 1;
    std::vector<std::vector<Rgb>> values(terms, std::vector<Rgb>(batches, Rgb(0.0)));
    oneapi::tbb::parallel_for(0, batches, [&](int batch) {
        const auto b = static_cast<std::size_t>(batch);
        Independent random(seed, static_cast<std::uint32_t>(batch));
        for (int i = 0; i < samples; ++i) {
            random.sampler.start(static_cast<std::uint64_t>(i));
            for (std::size_t k = 0; k < terms; ++k) values[k][b] += ask(k, random) / static_cast<double>(samples);
        }
    });
    std::vector<Mean> means;
    for (const auto& v : values) means.push_back(mean_of(v));
    return means;
}

template <class Op, class Field>
std::vector<Field> terms(const Op& K, const Field& first, int bounces) {
    NeumannSeries series(K, first);
    std::vector<Field> all{series.term()};
    while (series.bounce() < bounces) {
        series.advance();
        all.push_back(series.term());
    }
    return all;
}

struct Way {
    const char* name;
    std::vector<Mean> terms;
};

std::vector<Way> all_ways(const Scene& scene, int bounces, std::uint64_t seed, int samples) {
    const Film& film = scene.film;
    const CameraRay ray = scene.camera.ray(Vec2(film.crop_x + crop / 2, film.crop_y + crop / 2));
    SurfacePoint seen;
    if (!scene.geometry.first_hit(ray.origin, ray.direction, ray.length, seen)) throw std::logic_error("nothing is seen");
    // Incident radiance is asked for at the eye, as a point of a surface that faces the scene.
    const SurfacePoint eye{.position = ray.origin, .normal = ray.direction};

    const T t(scene.geometry);
    const R r(scene.materials);
    const AreaSampler surfaces(scene.geometry);
    const R_A r_a(scene.geometry, surfaces, scene.materials);
    const ExitantField Le = emission(scene.emitters);

    std::vector<Way> ways;
    const auto exitant = [&](const char* name, const auto& K) {
        const auto series = terms(K, Le, bounces);
        ways.push_back({name, estimate(bounces, seed + ways.size(), samples,
                                       [&](std::size_t k, Random& random) { return series[k](seen, -ray.direction, random); })});
    };
    const auto incident = [&](const char* name, const auto& K) {
        const auto series = terms(K, t(Le), bounces);
        ways.push_back({name, estimate(bounces, seed + ways.size(), samples,
                                       [&](std::size_t k, Random& random) { return series[k](eye, ray.direction, random); })});
    };
    exitant("exitant, directions", r * t);
    incident("incident, directions", t * r);
    exitant("exitant, surfaces", r_a * t);
    incident("incident, surfaces", t * r_a);

    const PictureSampler sampler(scene, {.walk = {.bounces = bounces, .rest_probability = 0.0},
                                         .sampler = SamplerKind::sobol,
                                         .seed = seed + 4,
                                         .replicate_size = 64});
    Tally tally(sampler.quantities());
    SeriesMoments moments(crop, crop, sampler.quantities());
    moments.add(*sampler.run(0, 8, tally));
    Way walk{"walk", {}};
    for (std::size_t k = 0; k <= static_cast<std::size_t>(bounces); ++k)
        walk.terms.push_back(mean_of(moments.result().term(k).mean.pixels));
    ways.push_back(std::move(walk));
    return ways;
}

// |z| ≤ 4.5 for all pairs, places, bounces and channels. `power`: the largest error of any way, relative to the walk's value.
void expect_agreement(std::span<const FilmPosition> at, int bounces, std::uint64_t seed, int samples, double power) {
    double largest = 0.0, worst_error = 0.0;
    int comparisons = 0;
    for (const FilmPosition& place : at) {
        const Scene scene = cornell_box(place);
        const auto ways = all_ways(scene, bounces, seed, samples);
        for (std::size_t k = 0; k <= static_cast<std::size_t>(bounces); ++k)
            for (std::size_t a = 0; a < ways.size(); ++a) {
                if (k == 0) {
                    EXPECT_EQ(ways[a].terms[0].mean, Rgb(0.0)) << "none of the places is on the light";
                    continue;
                }
                for (int c = 0; c < 3; ++c) {
                    const Mean& x = ways[a].terms[k];
                    ASSERT_GT(x.mean[c], 0.0);
                    worst_error = std::max(worst_error, x.error[c] / ways.back().terms[k].mean[c]);
                    for (std::size_t b = a + 1; b < ways.size(); ++b) {
                        const Mean& y = ways[b].terms[k];
                        const double z = (x.mean[c] - y.mean[c]) / std::hypot(x.error[c], y.error[c]);
                        EXPECT_LE(std::abs(z), 4.5)
                            << place.name << ", bounce " << k << ", channel " << c << ": " << ways[a].name << ' ' << x.mean[c]
                            << " ± " << x.error[c] << ", " << ways[b].name << ' ' << y.mean[c] << " ± " << y.error[c];
                        largest = std::max(largest, std::abs(z));
                        ++comparisons;
                    }
                }
            }
    }
    std::printf("largest |z| of %d: %.2f; largest error %.2f%%\n", comparisons, largest, 100 * worst_error);
    EXPECT_LE(worst_error, power);
}

// 6 places × 10 pairs × 3 channels = 180 comparisons.
TEST(Agreement, OfTheFourFormsAndTheWalkOnDirectLight) { expect_agreement(places, 1, 1, 1024, 0.065); }
// 4 places, two bounces: 240. (With three, the surface form has infinite variance: two random points on walls that meet.) A random
// point on all surfaces is on the light in less than 1% of the cases, so the surface forms need many.
TEST(AgreementSlow, OfTheFourFormsAndTheWalkOnTwoBounces) { expect_agreement(std::span(places).first(4), 2, 1, 20480, 0.1); }

}  // namespace neumann::agreement_forms_test
