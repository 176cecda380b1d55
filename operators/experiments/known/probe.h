// Estimates all terms K^i Le of a scene at one place, or on average over a set of places. Known answers are mostly for points, not
// pixels, so this runs walk() (walk.h) and the operators of pointwise directly. Standard errors come from 64 independent batches.
#pragma once

#include "core/scene/scene.h"
#include "operators/paths/walk/walk_settings.h"
#include "operators/pointwise/field.h"
#include "operators/statistics/tail_index.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace neumann::known {

// The start of a sample: the terms are estimated at `point`, leaving along `wo`, and multiplied by `weight`.
struct Start {
    SurfacePoint point;
    Vec3 wo;
    Rgb weight{1.0};
};
using StartPicker = std::function<Start(Random&)>;

// The surface point at exactly `p`, found by a ray from p + height · normal.
SurfacePoint surface_point(const Scene& scene, const Vec3& p, const Vec3& normal, double height = 1e-3);
// Always the same start, leaving along the normal. Diffuse surfaces look the same from every direction.
StartPicker at(const Scene& scene, const Vec3& p, const Vec3& normal, double height = 1e-3);
// The point seen from `origin` along `direction`.
StartPicker seen(const Scene& scene, const Vec3& origin, const Vec3& direction);
// Uniform on one shape, leaving its front along the normal.
StartPicker anywhere_on(const Scene& scene, std::uint32_t shape);

StartPicker anywhere(const Scene& scene);

// The way to estimate the terms: by the walk with its three kinds of direct light, or by the series of operators, with
// R as an integral over directions or over surfaces.
enum class Technique { mis, bsdf, light, pointwise, surfaces };
// The techniques that can follow mirrors and glass.
inline constexpr Technique specular_techniques[] = {Technique::mis, Technique::bsdf, Technique::light, Technique::pointwise};
std::string name(Technique technique);
// The technique in one word, for the names of cases.
std::string short_name(Technique technique);
// Whether the technique samples lights. The others find a light by chance, with its form factor as the probability.
inline bool looks_for_lights(Technique technique) { return technique == Technique::mis || technique == Technique::light; }

// The way walks go on: in directions sampled from the material, to points on all surfaces, or through mirrors alone.
enum class GoingOn { material, surfaces, specular };

inline constexpr int batch_count = 64;

// The default seed of ProbeSettings; the tests may take another one from the environment.
inline std::uint64_t default_seed = 20240229;

struct ProbeSettings {
    std::uint32_t samples = 4096;  // in each batch; a power of two
    int bounces = 8;
    double rest_probability = 0.0;  // 0: no rest
    int give_up = 1'000'000;
    SamplerKind sampler = SamplerKind::sobol;
    std::uint64_t seed = default_seed;
    std::optional<DirectLightSettings> direct = {};  // for walks, in place of the technique's own
    Roulette roulette = {};
    GoingOn going_on = GoingOn::material;  // for walks
    Split split = {};                      // for walks
};

struct Statistic {
    Rgb mean{0.0}, standard_error{0.0};
};

inline Statistic scaled(const Statistic& s, double factor) { return {s.mean * factor, s.standard_error * std::abs(factor)}; }

struct Estimates {
    std::vector<Statistic> terms;              // K^i Le, i = 0 … N
    Statistic rest;                            // Σ_{i>N}
    Statistic reflected;                       // Σ_{i≥1}, including the rest
    std::vector<Statistic> variance;           // of one sample of each term; unbiased with independent samples only
    Statistic rest_variance;                   // likewise
    std::vector<double> rays;                  // per sample, for each term and the rest
    double rays_mean = 0.0, rays_error = 0.0;  // the sum of these, with its standard error
    std::vector<LargestSamples> largest;       // of each term and the rest
    std::uint64_t given_up = 0;
    std::uint64_t samples = 0;
};

Estimates probe(const Scene& scene, const StartPicker& start, Technique technique, const ProbeSettings& settings);

// Takes more samples until the standard errors are at most 0.19% of the values, for all terms from K Le on that are not
// 0 and for the rest if it is estimated, or until a batch has `most` samples.
Estimates sharp_probe(const Scene& scene, const StartPicker& start, Technique technique, const ProbeSettings& settings,
                      std::uint32_t most = 1u << 17);

inline Rgb power_of(const Rgb& rho, int i) { return {std::pow(rho.r, i), std::pow(rho.g, i), std::pow(rho.b, i)}; }

}  // namespace neumann::known
