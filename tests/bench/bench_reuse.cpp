// What it would bring if pixels of a block shared the tails of their walks (Bekaert, Sbert and Halton, Accelerating Path Tracing by
// Re-Using Paths, 2002): all first vertices x_p of the block are joined to all second vertices y_q where both are diffuse, with the
// balance heuristic,
//
//     K^k Le at pixel p ≈ Σ_q ρ_p/π G(x_p, y_q) V(x_p, y_q) L_q / Σ_r G(x_r, y_q)/π V(x_r, y_q),   k ≥ 2
//
// with L_q the sample of K^{k−1} Le that the walk of q brings at y_q. Prints the efficiency, 1 / (variance of a pixel × rays),
// beside that of walks that share nothing.
//
//     bench_reuse [RESOLUTION [SAMPLES]] [SCENE.xml …]
#include "core/reader/read_scene.h"
#include "core/sampling/sampler.h"
#include "core/scene/camera_sample.h"
#include "operators/pictures/path_group.h"
#include "operators/walk/continuation.h"
#include "operators/walk/direct_light.h"
#include "operators/walk/walks.h"
#include "tests/bench/bench_arguments.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <string>

namespace {

using namespace neumann;

constexpr int bounces = 5;
constexpr std::size_t terms = bounces + 1;  // 2 … bounces are used, and their sum as number 0

struct Corner {
    SurfacePoint x, y;
    Vec3 nx{0.0}, ny{0.0};
    Rgb albedo{0.0};                // of x
    std::array<Rgb, terms> tail{};  // L_q of the bounce
    bool shares = false;            // x and y are diffuse
};

double kernel(const Corner& x, const Corner& y) {
    const Vec3 d = y.y.position - x.x.position;
    const double a = glm::dot(x.nx, d), b = -glm::dot(y.ny, d), d2 = glm::dot(d, d);
    return a > 0.0 && b > 0.0 ? a * b * inv_pi / (d2 * d2) : 0.0;
}

struct Sums {
    std::array<double, terms> variance_alone{}, variance_shared{};
    double mean_alone = 0.0, mean_shared = 0.0;  // of the sum
    double rays_alone = 0.0, rays_shared = 0.0;
};

// Of the block of `side`² pixels with its upper left one there.
Sums measure(const Scene& scene, const DirectLightSampler& direct, int left, int top, int side, std::uint32_t samples) {
    const std::size_t n = static_cast<std::size_t>(side * side);
    Sums sums;
    std::vector<std::array<Rgb, terms>> mean[2], square[2];
    for (int way : {0, 1}) {
        mean[way].resize(n);
        square[way].resize(n);
    }
    const WalkSettings tail_settings{.bounces = bounces - 1, .rest_probability = 0.0};
    std::vector<Sampler> samplers;
    for (std::size_t p = 0; p < n; ++p)
        samplers.emplace_back(7, static_cast<std::uint32_t>((top + static_cast<int>(p) / side) * scene.film.width + left +
                                                            static_cast<int>(p) % side));
    Walkers walkers, tails;
    for (std::uint32_t s = 0; s < samples; ++s) {
        std::vector<CameraRay> camera;
        for (std::size_t p = 0; p < n; ++p) {
            samplers[p].start(s);
            camera.push_back(
                sample_camera(scene, left + static_cast<int>(p) % side, top + static_cast<int>(p) / side, samplers[p]).ray);
        }
        std::vector<Rgb> emitted(n * (bounces + 2), Rgb(0.0));
        std::vector<std::uint64_t> rays(bounces + 2);
        TermSamples first{emitted, rays};
        start_walks(scene, {.bounces = bounces}, camera, walkers, first);
        // A light sample at x, and the direction to y.
        sums.rays_alone += static_cast<double>(n + 2 * walkers.alive.size());
        std::vector<Corner> corners(n);
        tails.begin(n);
        tails.alive.clear();
        for (const std::uint32_t p : walkers.alive) {
            const Walker& w = walkers.walker[p];
            const SurfaceSide side_of_x = scene.materials.side(w.x, w.wo);
            if (!side_of_x.bsdf) continue;
            const BsdfSample sampled = MaterialContinuation().sample(side_of_x, side_of_x.p.frame.to_local(w.wo), samplers[p]);
            if (sampled.pdf == 0.0) continue;
            const Vec3 wi = side_of_x.p.frame.to_world(sampled.wi);
            Corner& c = corners[p];
            if (!scene.geometry.first_hit(w.x, wi, c.y)) continue;
            c.x = w.x;
            c.nx = side_of_x.p.frame.n;
            c.albedo = sampled.weight;
            const SurfaceSide side_of_y = scene.materials.side(c.y, -wi);
            if (!side_of_y.bsdf) continue;
            c.ny = side_of_y.p.frame.n;
            c.shares = std::holds_alternative<Diffuse>(*side_of_x.bsdf) && std::holds_alternative<Diffuse>(*side_of_y.bsdf);
            tails.alive.push_back(p);
            Walker& tail = tails.walker[p];
            tail = {};
            tail.x = c.y;
            tail.wo = -wi;
        }
        std::vector<Rgb> found(n * (bounces + 1), Rgb(0.0));
        std::vector<std::uint64_t> of_tails(bounces + 1);
        TermSamples out{found, of_tails};
        walk_on(scene, direct, tail_settings, std::span(samplers), tails, out, MaterialContinuation());
        const double walked = static_cast<double>(std::accumulate(of_tails.begin(), of_tails.end(), std::uint64_t{0}));
        sums.rays_alone += walked;
        for (std::size_t q = 0; q < n; ++q)
            for (std::size_t k = 2; k < terms; ++k) corners[q].tail[k] = found[q * (bounces + 1) + k - 1];

        std::vector<double> seen(n * n, 0.0), all(n, 0.0);  // G V / π, and its sum over r
        for (std::size_t q = 0; q < n; ++q) {
            if (!corners[q].shares) continue;
            for (std::size_t p = 0; p < n; ++p) {
                if (!corners[p].shares) continue;
                const double g = kernel(corners[p], corners[q]);
                if (g == 0.0) continue;
                if (p != q) {
                    sums.rays_shared += 1.0;
                    if (!scene.geometry.visible(corners[p].x, corners[q].y)) continue;
                }
                seen[p * n + q] = g;
                all[q] += g;
            }
        }
        for (std::size_t p = 0; p < n; ++p) {
            std::array<Rgb, terms> value[2] = {};
            for (std::size_t k = 2; k < terms; ++k) {
                value[0][k] = corners[p].albedo * corners[p].tail[k];
                if (!corners[p].shares) {
                    value[1][k] = value[0][k];
                } else {
                    for (std::size_t q = 0; q < n; ++q)
                        if (seen[p * n + q] > 0.0)
                            value[1][k] += corners[p].albedo * corners[q].tail[k] * (seen[p * n + q] / all[q]);
                }
                for (auto& v : value) v[0] += v[k];
            }
            for (int way : {0, 1})
                for (std::size_t k = 0; k < terms; ++k) {
                    mean[way][p][k] += value[way][k];
                    square[way][p][k] += value[way][k] * value[way][k];
                }
        }
    }
    sums.rays_shared += sums.rays_alone;
    for (std::size_t p = 0; p < n; ++p)
        for (std::size_t k = 0; k < terms; ++k) {
            const auto variance = [&](int way) {
                const Rgb v = square[way][p][k] / double(samples) - mean[way][p][k] * mean[way][p][k] / (double(samples) * samples);
                return v.r + v.g + v.b;
            };
            sums.variance_alone[k] += variance(0);
            sums.variance_shared[k] += variance(1);
        }
    for (std::size_t p = 0; p < n; ++p) {
        sums.mean_alone += mean_component(mean[0][p][0]);
        sums.mean_shared += mean_component(mean[1][p][0]);
    }
    return sums;
}

}  // namespace

int main(int argc, char** argv) {
    const auto [resolution, samples, paths] = BenchArguments(argc, argv, "64", 64);
    for (const std::string& path : paths) {
        const Scene scene = read_scene(path, {{"res", resolution}});
        const DirectLightSampler direct(scene, {});
        for (const int side : {2, 4, 8}) {
            const int across = scene.film.crop_width / side, down = scene.film.crop_height / side;
            std::vector<Sums> blocks(static_cast<std::size_t>(across * down));
            oneapi::tbb::parallel_for(0, across * down, [&](int b) {
                blocks[static_cast<std::size_t>(b)] = measure(scene, direct, b % across * side, b / across * side, side, samples);
            });
            Sums all;
            for (const Sums& block : blocks) {
                all.rays_alone += block.rays_alone;
                all.rays_shared += block.rays_shared;
                all.mean_alone += block.mean_alone;
                all.mean_shared += block.mean_shared;
                for (std::size_t k = 0; k < terms; ++k) {
                    all.variance_alone[k] += block.variance_alone[k];
                    all.variance_shared[k] += block.variance_shared[k];
                }
            }
            std::string line = fmt::format(
                "{:16} {}x{} rays {:5.2f}; efficiency of bounces 2 …, each:", std::filesystem::path(path).stem().string(), side,
                side, all.rays_shared / all.rays_alone);
            for (std::size_t k = 2; k < terms; ++k)
                line +=
                    fmt::format(" {:5.2f}", all.variance_alone[k] * all.rays_alone / (all.variance_shared[k] * all.rays_shared));
            line += fmt::format("; their sum: {:5.2f}; means {:.4f}",
                                all.variance_alone[0] * all.rays_alone / (all.variance_shared[0] * all.rays_shared),
                                all.mean_shared / all.mean_alone);
            fmt::print("{}\n", line);
        }
    }
}
