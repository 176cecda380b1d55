#include "operators/paths/walk/tree_pilot.h"

#include "core/sampling/sampler.h"
#include "core/scene/camera_sample.h"
#include "operators/paths/walk/path_group.h"
#include "operators/paths/walk/walk.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <numeric>

namespace neumann {

namespace {

// The random numbers of one walk up to some place, and others from there on.
class PartingNumbers {
public:
    PartingNumbers(const Sampler& shared, const Sampler& own) : shared_(shared), own_(own) {}
    double next() { return has_parted_ ? own_.next() : shared_.next(); }
    Vec2 next2() { return has_parted_ ? own_.next2() : shared_.next2(); }
    void part() { has_parted_ = true; }

private:
    Sampler shared_, own_;
    bool has_parted_ = false;
};

// Makes walks part after they have cast their ray of this depth.
struct PartAfter : NoObserver {
    PartAfter(std::span<PartingNumbers> numbers, int depth) : numbers(numbers), depth(depth) {}
    void casts(std::uint32_t path, bool, int reflections, const PathEnd&) const {
        if (reflections == depth) numbers[path].part();
    }
    std::span<PartingNumbers> numbers;
    int depth;
};

// E[X X'] of walks that share nothing, depth 0, depths 0 and 1, …, all; and E[Y Y'], where Y is the contribution of
// depth j and later ones.
struct Products {
    explicit Products(std::size_t depths) : of_goals(depths + 1, std::vector<double>(depths + 1, 0.0)), remainders(of_goals) {}
    std::vector<std::vector<double>> of_goals, remainders;  // by goal (bounces, and the sum) and number of depths that are shared
    void add(const Products& other) {
        for (std::size_t g = 0; g < of_goals.size(); ++g)
            for (std::size_t j = 0; j < of_goals[g].size(); ++j) {
                of_goals[g][j] += other.of_goals[g][j];
                remainders[g][j] += other.remainders[g][j];
            }
    }
};

TreeMoments moments(const std::vector<double>& products, const std::vector<double>& remainders, const std::vector<double>& costs) {
    TreeMoments tree;
    tree.cost = costs;
    for (std::size_t j = 0; j < costs.size(); ++j) {
        tree.variance.push_back(std::max(products[j + 1] - products[j], 0.0));
        tree.remainder.push_back(j == 0 ? 0.0 : std::max(remainders[j], 0.0));
    }
    return tree;
}

}  // namespace

TreePilot measure_tree(const Scene& scene, int bounces, std::uint32_t samples, std::uint64_t seed, const Watch& watch) {
    const WalkSettings settings{.bounces = bounces, .rest_probability = 0.0};
    const DirectLightSampler direct(scene, settings.direct);
    const auto depths = static_cast<std::size_t>(bounces) + 1, Q = depths + 1;
    const auto pixels = static_cast<std::uint32_t>(scene.film.crop_width * scene.film.crop_height);
    // The results are added up in the order of pixels, so that the sums do not depend on the number of threads.
    std::vector<Products> of_pixels(pixels, Products(depths));
    std::vector<std::vector<std::uint64_t>> rays_of_pixels(pixels, std::vector<std::uint64_t>(Q));
    std::atomic<std::uint64_t> all_rays = 0;
    oneapi::tbb::parallel_for(std::uint32_t{0}, pixels, [&](std::uint32_t number) {
        if (watch.stop()) return;
        const Pixel pixel = pixel_of(scene.film, number);
        Walkers walkers;
        // The walks of this pixel: all first ones, or their partners that share `shared` depths with them.
        const auto walk_all = [&](std::size_t shared, std::vector<std::uint64_t>& rays) {
            std::vector<PartingNumbers> numbers;
            std::vector<CameraRay> camera;
            std::vector<double> weights;
            for (std::uint32_t i = 0; i < samples; ++i) {
                Sampler first(seed, number), own(seed, number);
                first.start(i);
                own.start((std::uint64_t{shared} + 1) * samples + i);
                numbers.emplace_back(first, own);
                if (shared == 0) numbers.back().part();
                const CameraSample sample = sample_camera(scene, pixel.x, pixel.y, numbers.back());
                camera.push_back(sample.ray);
                weights.push_back(sample.weight);
            }
            std::vector<Rgb> found(samples * Q, Rgb(0.0));
            TermSamples out{found, rays};
            const int depth = shared == 0 || shared == depths ? -1 : static_cast<int>(shared) - 1;
            walk(scene, scene.geometry, direct, settings, std::span<const CameraRay>(camera), std::span(numbers), walkers, out,
                 MaterialContinuation(), PartAfter(numbers, depth));
            for (std::size_t k = 0; k < found.size(); ++k) found[k] *= weights[k / Q];
            return found;
        };
        const std::vector<Rgb> first = walk_all(depths, rays_of_pixels[number]);
        Products& products = of_pixels[number];
        std::vector<std::uint64_t> of_partners(Q);
        for (std::size_t shared = 0; shared <= depths; ++shared) {
            const std::vector<Rgb> partner = shared == depths ? first : walk_all(shared, of_partners);
            for (std::uint32_t i = 0; i < samples; ++i) {
                const Rgb *const x = &first[i * Q], *const y = &partner[i * Q];
                Rgb sum_x(0.0), sum_y(0.0);
                for (std::size_t k = depths; k-- > 0;) {
                    products.of_goals[k][shared] += glm::dot(x[k], y[k]);
                    if (k >= shared) products.remainders[k][shared] += glm::dot(x[k], y[k]);
                    sum_x += x[k];
                    sum_y += y[k];
                    if (k == shared) products.remainders[depths][shared] += glm::dot(sum_x, sum_y);
                }
                products.of_goals[depths][shared] += glm::dot(sum_x, sum_y);
            }
        }
        for (const auto* rays : {&rays_of_pixels[number], &of_partners})
            all_rays += std::accumulate(rays->begin(), rays->end(), std::uint64_t{0});
    });
    if (watch.stop()) throw Stopped();
    Products all(depths);
    std::vector<double> costs(depths, 0.0);
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
        all.add(of_pixels[pixel]);
        for (std::size_t j = 0; j < depths; ++j)
            costs[j] += static_cast<double>(rays_of_pixels[pixel][j]) / (static_cast<double>(pixels) * samples);
    }
    for (auto* sums : {&all.of_goals, &all.remainders})
        for (auto& goal : *sums)
            for (double& x : goal) x /= samples;
    TreePilot pilot;
    pilot.rays = all_rays;
    for (std::size_t k = 0; k < depths; ++k) pilot.bounces.push_back(moments(all.of_goals[k], all.remainders[k], costs));
    pilot.sum = moments(all.of_goals[depths], all.remainders[depths], costs);
    return pilot;
}

}  // namespace neumann
