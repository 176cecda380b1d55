#include "operators/fields/matrix/camera_vector.h"

#include "core/sampling/sampler.h"
#include "core/scene/camera_sample.h"
#include "core/scene/pass_lights.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <array>
#include <vector>

namespace neumann {

namespace {

constexpr std::uint64_t camera_stream = 0x63616d657261ull;

// Calls add(pixel, unknown, weight) for every camera ray in order; the weights of a pixel sum to `samples` on average.
template <class Add>
void look_through(const Scene& scene, const PatchSpace& space, std::uint32_t samples, std::uint64_t seed, const Add& add) {
    constexpr std::uint32_t packet = RayCaster::packet_size;
    const Film& film = scene.film;
    const auto width = static_cast<std::uint32_t>(film.crop_width), height = static_cast<std::uint32_t>(film.crop_height),
               rays = width * samples;  // of a row
    const SobolPoints points(samples);
    std::vector<std::uint32_t> seen(rays);
    std::vector<double> weights(rays);
    const auto look = [&](std::uint32_t y, std::uint32_t begin) {
        const std::uint32_t n = std::min(packet, rays - begin);
        std::array<Ray, packet> ray;
        std::array<SurfacePoint, packet> hit;
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t x = (begin + i) / samples;
            Sampler sampler(points, seed ^ camera_stream, y * width + x);
            sampler.start((begin + i) % samples);
            const CameraSample sample =
                sample_camera(scene, film.crop_x + static_cast<int>(x), film.crop_y + static_cast<int>(y), sampler);
            ray[i] = sample.ray;
            weights[begin + i] = sample.weight;
        }
        const std::uint32_t found =
            scene.geometry.first_hits(std::span<const Ray>(ray).first(n), [&](std::size_t i) -> SurfacePoint& { return hit[i]; });
        std::uint64_t cast = 0;
        for (std::uint32_t i = 0; i < n; ++i) {
            const Vec3& w = ray[i].direction;
            const bool meets =
                (found >> i & 1u) && (!scene.hide_emitters || pass_lights(scene.emitters, scene.geometry, w, hit[i], cast));
            seen[begin + i] = meets ? space.unknown(hit[i], -w) : space.nothing();
        }
    };
    for (std::uint32_t y = 0; y < height; ++y) {
        oneapi::tbb::parallel_for(std::uint32_t{0}, (rays + packet - 1) / packet, [&](std::uint32_t p) { look(y, p * packet); });
        for (std::uint32_t i = 0; i < rays; ++i) add(y * width + i / samples, seen[i], weights[i]);
    }
}

}  // namespace

template <int C>
ExitantVector<C> camera_importance(const Scene& scene, const PatchSpace& space, std::uint32_t samples, std::uint64_t seed) {
    ExitantVector<C> We = ExitantVector<C>::zero(space.size());
    look_through(scene, space, samples, seed,
                 [&](std::uint32_t, std::uint32_t unknown, double weight) { We.col(unknown) += to_channels<C>(Rgb(weight)); });
    We.col(space.nothing()).setZero();
    const double all = static_cast<double>(scene.film.crop_width) * scene.film.crop_height * samples;
    for (const Facet& facet : space.facets())
        for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u) We.col(u) /= all * space.measure(facet);
    return We;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> camera_matrix(const Scene& scene, const PatchSpace& space, std::uint32_t samples,
                                                           std::uint64_t seed) {
    std::vector<Eigen::Triplet<double, std::uint32_t>> entries;
    look_through(scene, space, samples, seed, [&](std::uint32_t pixel, std::uint32_t unknown, double weight) {
        if (unknown != space.nothing()) entries.emplace_back(pixel, unknown, weight / samples);
    });
    Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(Eigen::Index{scene.film.crop_width} * scene.film.crop_height, space.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

template ExitantVector<1> camera_importance<1>(const Scene&, const PatchSpace&, std::uint32_t, std::uint64_t);
template ExitantVector<4> camera_importance<4>(const Scene&, const PatchSpace&, std::uint32_t, std::uint64_t);

}  // namespace neumann
