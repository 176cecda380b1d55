#include "operators/experiments/known/probe.h"

#include "core/geometry/area_sampler.h"
#include "core/sampling/sampler.h"
#include "operators/algebra/neumann_series.h"
#include "operators/paths/walk/walks.h"
#include "operators/pointwise/emission.h"
#include "operators/pointwise/reflection.h"
#include "operators/pointwise/surface_reflection.h"
#include "operators/pointwise/transport.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <map>
#include <mutex>
#include <optional>

namespace neumann::known {

namespace {

// Mean and squared deviations in a form in which equal samples have exactly no variance.
struct Welford {
    double n = 0.0;
    Rgb mean{0.0}, m2{0.0};

    void add(const Rgb& x) {
        n += 1.0;
        const Rgb difference = x - mean;
        mean += difference / n;
        m2 += difference * (x - mean);
    }
    Rgb variance() const { return m2 / (n - 1.0); }
    Statistic statistic() const { return {mean, glm::sqrt(variance() / n)}; }
};

struct FromSampler : Random {
    explicit FromSampler(Sampler& s) : sampler(s) {}
    double next() override { return sampler.next(); }
    Sampler& sampler;
};

DirectLight direct_light(Technique technique) {
    return technique == Technique::bsdf ? DirectLight::bsdf : technique == Technique::light ? DirectLight::light : DirectLight::mis;
}

// The terms as functions, for techniques that are not walks.
struct Series {
    std::optional<AreaSampler> surfaces;
    std::vector<ExitantField> terms;

    template <class Reflection>
    void develop(const Scene& scene, const Reflection& R, int bounces) {
        const auto K = R * TransportOperator(scene.geometry);
        NeumannSeries series(K, emission(scene.emitters));
        for (terms.push_back(series.term()); series.bounce() < bounces; terms.push_back(series.term())) series.advance();
    }
    Series(const Scene& scene, Technique technique, int bounces) {
        if (technique == Technique::pointwise) develop(scene, ReflectionOperator(scene.materials), bounces);
        if (technique == Technique::surfaces) {
            surfaces.emplace(scene.geometry);
            develop(scene, SurfaceReflectionOperator(scene.geometry, *surfaces, scene.materials), bounces);
        }
    }
};

struct Batch {
    explicit Batch(std::size_t n) : quantities(n + 1), rays(n), largest(n) {}

    std::vector<Welford> quantities;  // 0 … N, the rest, Σ_{i≥1}
    std::vector<std::uint64_t> rays;
    std::vector<LargestSamples> largest;
    std::uint64_t given_up = 0;
};

constexpr std::uint32_t together = 64;  // walks that advance together

// Adds samples begin … end − 1, in packets of `together`.
void run_batch(const Scene& scene, const StartPicker& pick, Technique technique, const ProbeSettings& settings,
               const Series& series, const Sampler& sampler, std::uint32_t begin, std::uint32_t end, Batch& batch) {
    const auto quantities = static_cast<std::size_t>(settings.bounces) + 2;
    const WalkSettings of_walk{.bounces = settings.bounces,
                               .direct = settings.direct.value_or(DirectLightSettings{direct_light(technique)}),
                               .roulette = settings.roulette,
                               .split = settings.split,
                               .rest_probability = settings.rest_probability,
                               .give_up = settings.give_up};
    const DirectLightSampler direct(scene, of_walk.direct);
    const std::uint32_t packet = std::min(end - begin, together);
    std::vector<Sampler> samplers(packet, sampler);
    std::vector<Start> starts(packet);
    std::vector<Rgb> samples(packet * quantities);
    Walkers walkers;
    TermSamples result{samples, batch.rays};
    // Walks whose first vertices are given.
    const auto walk_from_starts = [&](const auto& continuation) {
        walkers.begin(packet);
        result.rays[0] += packet;
        for (std::uint32_t i = 0; i < packet; ++i) {
            Walker& w = walkers.walker[i];
            w.x = starts[i].point;
            w.wo = starts[i].wo;
            w.pdf = 0.0;
            w.beta = Rgb(1.0);
            samples[i * quantities] += scene.emitters.emitted(w.x, w.wo);
        }
        walk_on(scene, direct, of_walk, samplers, walkers, result, continuation);
    };
    for (std::uint32_t first = begin; first < end; first += packet) {
        std::fill(samples.begin(), samples.end(), Rgb(0.0));
        for (std::uint32_t i = 0; i < packet; ++i) {
            samplers[i].start(first + i);
            FromSampler random(samplers[i]);
            starts[i] = pick(random);
            for (std::size_t k = 0; k < series.terms.size(); ++k)
                samples[i * quantities + k] = series.terms[k](starts[i].point, starts[i].wo, random);
        }
        if (series.terms.empty()) {
            if (settings.going_on == GoingOn::material) walk_from_starts(MaterialContinuation());
            if (settings.going_on == GoingOn::surfaces) walk_from_starts(SurfaceContinuation(scene.geometry));
            if (settings.going_on == GoingOn::specular) walk_from_starts(SpecularContinuation());
        }
        for (std::uint32_t i = 0; i < packet; ++i) {
            Rgb reflected(0.0);
            for (std::size_t q = 0; q < quantities; ++q) {
                const Rgb x = starts[i].weight * samples[i * quantities + q];
                batch.quantities[q].add(x);
                batch.largest[q].add(max_component(x));
                if (q > 0) reflected += x;
            }
            batch.quantities[quantities].add(reflected);
        }
    }
    for (LargestSamples& largest : batch.largest) largest.add_count(end - begin);
    batch.given_up += result.given_up;
}

const SobolPoints& sobol_points(std::uint32_t size) {
    static std::mutex mutex;
    static std::map<std::uint32_t, SobolPoints> known;
    const std::lock_guard lock(mutex);
    return known.try_emplace(size, size).first->second;
}

class Probe {
public:
    // `most`: the largest number of samples that a batch will ever have.
    Probe(const Scene& scene, const StartPicker& start, Technique technique, const ProbeSettings& settings, std::uint32_t most)
        : scene_(scene),
          start_(start),
          technique_(technique),
          settings_(settings),
          points_(settings.sampler == SamplerKind::sobol ? &sobol_points(most) : nullptr),
          series_(scene, technique, settings.bounces),
          batches_(batch_count, Batch(static_cast<std::size_t>(settings.bounces) + 2)) {}

    // Samples up to this number in each batch.
    void sample_to(std::uint32_t samples) {
        oneapi::tbb::parallel_for(std::uint32_t{0}, std::uint32_t{batch_count}, [&](std::uint32_t b) {
            run_batch(scene_, start_, technique_, settings_, series_,
                      points_ ? Sampler(*points_, settings_.seed, b) : Sampler(settings_.seed, b), samples_, samples, batches_[b]);
        });
        samples_ = samples;
    }

    Estimates estimates() const;

private:
    const Scene& scene_;
    const StartPicker& start_;
    Technique technique_;
    const ProbeSettings& settings_;
    const SobolPoints* points_;
    Series series_;
    std::vector<Batch> batches_;
    std::uint32_t samples_ = 0;  // of each batch
};

Estimates Probe::estimates() const {
    const auto quantities = static_cast<std::size_t>(settings_.bounces) + 2;
    std::vector<Welford> means(quantities + 1), variances(quantities);
    Welford rays;
    Estimates result;
    result.rays.resize(quantities);
    result.largest.resize(quantities);
    for (const Batch& batch : batches_) {
        double batch_rays = 0.0;
        for (std::size_t q = 0; q < quantities; ++q) {
            variances[q].add(batch.quantities[q].variance());
            result.rays[q] += static_cast<double>(batch.rays[q]) / samples_ / batch_count;
            batch_rays += static_cast<double>(batch.rays[q]) / samples_;
            result.largest[q].merge(batch.largest[q]);
        }
        for (std::size_t q = 0; q <= quantities; ++q) means[q].add(batch.quantities[q].mean);
        rays.add(Rgb(batch_rays));
        result.given_up += batch.given_up;
    }
    for (std::size_t q = 0; q + 1 < quantities; ++q) {
        result.terms.push_back(means[q].statistic());
        result.variance.push_back(variances[q].statistic());
    }
    result.rest_variance = variances[quantities - 1].statistic();
    result.rest = means[quantities - 1].statistic();
    result.reflected = means[quantities].statistic();
    result.rays_mean = rays.statistic().mean.r;
    result.rays_error = rays.statistic().standard_error.r;
    result.samples = std::uint64_t{batch_count} * samples_;
    return result;
}

}  // namespace

SurfacePoint surface_point(const Scene& scene, const Vec3& p, const Vec3& normal, double height) {
    SurfacePoint point;
    if (!scene.geometry.first_hit(p + normal * height, -normal, 2.0 * height, point) ||
        glm::length(point.position - p) > 0.1 * height)
        throw std::logic_error("there is no surface here");
    point.position = p;
    return point;
}

StartPicker at(const Scene& scene, const Vec3& p, const Vec3& normal, double height) {
    return [start = Start{surface_point(scene, p, normal, height), normal}](Random&) { return start; };
}

StartPicker seen(const Scene& scene, const Vec3& origin, const Vec3& direction) {
    const Vec3 d = glm::normalize(direction);
    SurfacePoint p;
    if (!scene.geometry.first_hit(origin, d, 1e9, p)) throw std::logic_error("there is no surface here");
    return [start = Start{p, -d}](Random&) { return start; };
}

StartPicker anywhere_on(const Scene& scene, std::uint32_t shape) {
    std::vector<double> cumulative;
    for (std::uint32_t i = 0; i < scene.geometry.primitive_count(shape); ++i)
        cumulative.push_back(scene.geometry.area(shape, i) + (i ? cumulative.back() : 0.0));
    return [&geometry = scene.geometry, shape, cumulative](Random& random) {
        const double choice = random.next() * cumulative.back();
        const auto found = std::upper_bound(cumulative.begin(), cumulative.end() - 1, choice);
        const SurfacePoint p = geometry.point(shape, static_cast<std::uint32_t>(found - cumulative.begin()), random.next2());
        return Start{p, p.normal};
    };
}

StartPicker anywhere(const Scene& scene) {
    return [surfaces = AreaSampler(scene.geometry)](Random& random) {
        const double choice = random.next();
        const SurfacePoint p = surfaces.sample(choice, random.next2());
        return Start{p, p.normal};
    };
}

std::string name(Technique technique) {
    switch (technique) {
        case Technique::mis:
            return "walk, direct light by MIS";
        case Technique::bsdf:
            return "walk, direct light by BSDF sampling";
        case Technique::light:
            return "walk, direct light by light sampling";
        case Technique::pointwise:
            return "operators, R over the hemisphere";
        case Technique::surfaces:
            return "operators, R over surfaces";
    }
    return "";
}

std::string short_name(Technique technique) {
    constexpr const char* names[] = {"mis", "bsdf", "light", "pointwise", "surfaces"};
    return names[static_cast<std::size_t>(technique)];
}

Estimates probe(const Scene& scene, const StartPicker& start, Technique technique, const ProbeSettings& settings) {
    Probe probe(scene, start, technique, settings, settings.samples);
    probe.sample_to(settings.samples);
    return probe.estimates();
}

Estimates sharp_probe(const Scene& scene, const StartPicker& start, Technique technique, const ProbeSettings& settings,
                      std::uint32_t most) {
    const auto excess = [](const Statistic& s) { return s.standard_error.r / (0.0019 * std::abs(s.mean.r)); };  // NaN: 0 ± 0
    Probe probe(scene, start, technique, settings, most);
    for (std::uint32_t samples = settings.samples;;) {
        probe.sample_to(samples);
        Estimates found = probe.estimates();
        double largest = settings.rest_probability > 0.0 ? excess(found.rest) : 0.0;
        for (std::size_t i = 1; i < found.terms.size(); ++i) largest = std::fmax(largest, excess(found.terms[i]));
        if (largest <= 1.0 || samples >= most) return found;
        // The number grows as the squared error requires, by an eighth to all of the present one, in whole packets.
        const double more = samples * std::clamp(largest * largest - 1.0, 0.125, 1.0);
        samples = std::min(samples + together * static_cast<std::uint32_t>(std::ceil(more / together)), most);
    }
}

}  // namespace neumann::known
