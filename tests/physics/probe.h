// Asks a scene for all terms K^i Le at one place and compares the answers with what is known.
//
// The policy of CONTRIBUTING.md: standard errors come from 64 independent batches, a value passes at |z| ≤ 4.5, and the standard
// error has to be at most 0.2% of the reference. With the 63 degrees of freedom of 64 batches |z| > 4.5 is a false alarm in 3.0e-5
// of all comparisons (Student's t; 6.8e-6 for a normal z). The whole of this folder makes about 1500 of them: 4% for a new seed,
// and none with the fixed one.
#pragma once

#include "core/scene/scene.h"
#include "operators/pointwise/field.h"
#include "operators/statistics/tail_index.h"
#include "operators/walk/walk.h"
#include "tests/physics/seed.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace neumann::physics {

// Where a sample starts: the terms are asked for at `point`, leaving along `wo`, and are multiplied by `weight`.
struct Start {
    SurfacePoint point;
    Vec3 wo;
    Rgb weight{1.0};
};
using StartPicker = std::function<Start(Random&)>;

// The surface point at exactly `p`, as seen from p + height · normal.
SurfacePoint surface_point(const Scene& scene, const Vec3& p, const Vec3& normal, double height = 1e-3);
// Always the same start, leaving along the normal. Diffuse surfaces look alike from everywhere.
StartPicker at(const Scene& scene, const Vec3& p, const Vec3& normal, double height = 1e-3);
// Uniform on one shape, leaving its front along the normal.
StartPicker anywhere_on(const Scene& scene, std::uint32_t shape);

// Uniform on all surfaces.
StartPicker anywhere(const Scene& scene);

// How the terms are estimated: by the walk with its three kinds of direct light, or by the series of operators, with R as an
// integral over directions or over surfaces.
enum class Way { mis, bsdf, light, pointwise, surfaces };
std::string name(Way way);
// The others find a light by chance, with a probability that is its form factor, and need many more samples.
inline bool looks_for_lights(Way way) { return way == Way::mis || way == Way::light; }

// How walks go on: by directions of the material, by points on all surfaces, by mirrors alone.
enum class GoingOn { material, surfaces, specular };

inline constexpr int batch_count = 64;

struct Effort {
    std::uint32_t samples = 4096;  // a batch; a power of two
    int bounces = 8;
    double rest_probability = 0.0;  // 0: no rest
    int give_up = 1'000'000;
    SamplerKind sampler = SamplerKind::sobol;
    std::uint64_t seed = fixed_seed;
    std::optional<DirectLightSettings> direct = {};  // of a walk, in place of its way's
    Roulette roulette = {};
    GoingOn going_on = GoingOn::material;  // of a walk
    Split split = {};                      // likewise
};

struct Statistic {
    Rgb mean{0.0}, standard_error{0.0};
};

struct Estimates {
    std::vector<Statistic> terms;              // K^i Le, i = 0 … N
    Statistic rest;                            // Σ_{i>N}
    Statistic reflected;                       // Σ_{i≥1}, with the rest
    std::vector<Statistic> variance;           // of one sample of each term; unbiased with independent samples only
    Statistic rest_variance;                   // likewise
    std::vector<double> rays;                  // a sample: for each term and the rest
    double rays_mean = 0.0, rays_error = 0.0;  // of all of them together, with the standard error
    std::vector<LargestSamples> largest;       // of each term and the rest
    std::uint64_t given_up = 0;
    std::uint64_t samples = 0;
};

Estimates probe(const Scene& scene, const StartPicker& start, Way way, const Effort& effort);

constexpr double z_limit = 4.5;
constexpr double power = 0.002;  // the largest standard error, relative to the reference
// A value that is exactly zero has to be found as exactly zero, everything else as said above. Rounding may add n ε, for a mean of
// n samples is rounded n times; no batch has more than 2^17.
void expect_matches(const Statistic& found, double exact, const std::string& what, double largest_error = power);
// `exact[k]` belongs to K^{first+k} Le. First channel.
void expect_matches(const Estimates& found, std::span<const double> exact, int first = 0, double largest_error = power);

// Samples without variance: |K^i Le − exact| ≤ 8 i ε, standard error exactly 0. All channels.
void expect_exact(const Estimates& found, const std::function<Rgb(int)>& exact);

inline Rgb power_of(const Rgb& rho, int i) { return {std::pow(rho.r, i), std::pow(rho.g, i), std::pow(rho.b, i)}; }

}  // namespace neumann::physics
