// The walk and the plain operators say the same of every bounce of the Cornell box: pictures of 32×32 pixels, their means and those
// of blocks of 8×8.
#include "core/reader/read_scene.h"
#include "operators/render/from_paths/picture_sampler.h"
#include "tests/physics/paths_of.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace neumann::agreement_pictures_test {

constexpr int resolution = 32, bounces = 4;

SeriesMoments::Result render(const Scene& scene, const std::shared_ptr<const PathMethod>& method, DirectLight direct,
                             std::uint64_t seed, std::uint64_t samples) {
    constexpr std::uint32_t replicate_size = 16;
    const PictureSampler sampler(scene, {.method = method,
                                         .walk = {.bounces = bounces, .direct = {direct}, .rest_probability = 0.0},
                                         .sampler = SamplerKind::sobol,
                                         .seed = seed,
                                         .replicate_size = replicate_size});
    Tally tally(sampler.quantities());
    SeriesMoments moments(resolution, resolution, sampler.quantities());
    moments.add(*sampler.run(0, samples / replicate_size, tally));
    return moments.result();
}

struct Comparison {
    int count = 0, beyond_two = 0;
    double largest = 0.0, worst_error = 0.0;
};

// Means over blocks of size × size pixels, of all channels.
void compare_blocks(const Estimate& a, const Estimate& b, int size, const std::string& what, Comparison& found) {
    for (int y0 = 0; y0 < resolution; y0 += size)
        for (int x0 = 0; x0 < resolution; x0 += size) {
            Rgb difference(0.0), variance(0.0), mean(0.0);
            for (int y = y0; y < y0 + size; ++y)
                for (int x = x0; x < x0 + size; ++x) {
                    difference += a.mean.at(x, y) - b.mean.at(x, y);
                    mean += b.mean.at(x, y);
                    variance += a.standard_error.at(x, y) * a.standard_error.at(x, y) +
                                b.standard_error.at(x, y) * b.standard_error.at(x, y);
                }
            for (int c = 0; c < 3; ++c) {
                if (variance[c] == 0.0) {  // bounce 0, where no edge of the light is seen
                    EXPECT_EQ(difference[c], 0.0) << what;
                    continue;
                }
                const double z = difference[c] / std::sqrt(variance[c]);
                EXPECT_LE(std::abs(z), 4.5) << what << ", blocks of " << size << ", at " << x0 << ", " << y0 << ", channel " << c;
                ++found.count;
                found.beyond_two += std::abs(z) > 2.0;
                found.largest = std::max(found.largest, std::abs(z));
                if (size == resolution) found.worst_error = std::max(found.worst_error, std::sqrt(variance[c]) / mean[c]);
            }
        }
}

// Terms and sums, means over the picture and over blocks; the operators against each kind of direct light (here no wall stands at
// an angle to the light where it touches, so that all three have finite variance). 1278 comparisons, in which the operators'
// pictures take part three times each. The operators do not look for the light, so the error of the picture's mean is 0.2% for
// bounce 0 and rises to 1% for bounce 4, in the light's weak blue to 2%.
TEST(AgreementSlow, OfTheOperatorsAndTheWalkInEveryBounce) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", std::to_string(resolution)}});
    const auto operators = render(scene, physics::paths_of(method::Pointwise{}), DirectLight::bsdf, 1, 8192);
    Comparison found;
    for (const DirectLight direct : {DirectLight::mis, DirectLight::bsdf, DirectLight::light}) {
        const auto walk =
            render(scene, plain_walks(), direct, 2 + static_cast<std::uint64_t>(direct), direct == DirectLight::bsdf ? 4096 : 512);
        for (std::size_t i = 0; i <= bounces; ++i)
            for (const int size : {resolution, 8}) {
                const std::string what =
                    "direct light " + std::to_string(static_cast<int>(direct)) + ", bounce " + std::to_string(i);
                compare_blocks(walk.term(i), operators.term(i), size, what, found);
                compare_blocks(walk.sum(i), operators.sum(i), size, what + ", sum", found);
            }
    }
    std::printf("largest |z| of %d: %.2f; beyond 2: %.1f%%; largest error of a picture's mean: %.2f%%\n", found.count,
                found.largest, 100.0 * found.beyond_two / found.count, 100.0 * found.worst_error);
    EXPECT_LE(found.worst_error, 0.025);
}

}  // namespace neumann::agreement_pictures_test
