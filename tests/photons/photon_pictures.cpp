// The bias and the variance of pictures by photon maps fall with the number of passes as theory has it.
#include "core/reader/read_scene.h"
#include "operators/render/methods/method_options.h"
#include "tests/physics/picture_blocks.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace neumann::photon_pictures_test {

using physics::Blocks;
using physics::fixed_seed;
using physics::settings_of;

// A lamp shines at a ceiling, whose light the floor reflects in bounce 2: seen is a small part of the floor, where the light is
// smooth.
const char* const floor_of_a_room = R"(<scene version="3.0.0">
<sensor type="perspective">
  <float name="fov" value="3"/>
  <transform name="to_world"><lookat origin="0.3, 0, 0.4" target="0.3, 0, 0" up="0, 1, 0"/></transform>
  <film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/><rfilter type="box"/></film>
</sensor>
<bsdf type="diffuse" id="white"><rgb name="reflectance" value=".8"/></bsdf>
<shape type="rectangle"><transform name="to_world"><scale value="20"/></transform><ref id="white"/></shape>
<shape type="rectangle">
  <transform name="to_world"><scale value="20"/><rotate x="1" angle="180"/><translate z="1"/></transform><ref id="white"/>
</shape>
<shape type="rectangle">
  <transform name="to_world"><scale value=".05"/><translate x="-.1" z=".8"/></transform>
  <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf><emitter type="area"><rgb name="radiance" value="1000"/></emitter>
</shape>
</scene>)";

// Knaus and Zwicker: of the mean over n passes the bias is in proportion to the mean of r² and falls as n^(α − 1), and the variance
// of a pass to 1/r², so that that of the mean falls as n^(−α). The largest radius is large, so that the bias stands out from the
// noise: by 64 passes it is more than ten standard errors, and its next order, r⁴, allows a seventh of it; were it constant, or in
// proportion to r, that of 1024 passes would differ from what is expected by more than half of it. Variances from n passes have a
// relative standard deviation of √(2/n).
TEST(PhotonPicturesSlow, BiasAndVarianceFallAsTheoryHasIt) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "neumann_photon_floor.xml";
    std::ofstream(file) << floor_of_a_room;
    const Scene scene = read_scene(file);
    std::filesystem::remove(file);
    const Blocks truth(scene, settings_of(scene, method::Bidirectional{}, 2, fixed_seed), 4, 4096);
    const Blocks photons(
        scene,
        settings_of(scene, make_method({"photon", {{"photons", "16384"}, {"radius", "0.7"}, {"sampler", "independent"}}}), 2,
                    fixed_seed + 1),
        4, 1024);
    const auto expected = [](std::uint64_t n) {
        double squares = 0.0;
        for (std::uint64_t i = 0; i < n; ++i) squares += relative_radius(i) * relative_radius(i);
        return squares / static_cast<double>(n);
    };
    const auto exact = truth.at(0, 2, 0, truth.replicates());
    const auto bias = [&](std::uint64_t n) { return photons.at(0, 2, 0, n).mean - exact.mean; };
    const auto error = [&](std::uint64_t n) { return std::hypot(photons.at(0, 2, 0, n).error, exact.error); };
    std::printf("bias of %g: %g ± %g, %g ± %g, %g ± %g\n", exact.mean, bias(64), error(64), bias(256), error(256), bias(1024),
                error(1024));
    EXPECT_GT(std::abs(bias(64)), 10.0 * error(64));
    for (const std::uint64_t n : {256, 1024}) {
        const double theory = bias(64) * expected(n) / expected(64);
        EXPECT_LE(std::abs(bias(n) - theory), 4.5 * error(n) + std::abs(theory) / 7.0) << n;
        // What the pictures say of it themselves, by their two radii.
        EXPECT_GE(photons.at(0, 2, 0, n).bias, std::abs(bias(n)) - 4.5 * error(n)) << n;
    }
    const auto inverse = [](std::uint64_t begin, std::uint64_t end) {
        double sum = 0.0;
        for (std::uint64_t i = begin; i < end; ++i) sum += 1.0 / (relative_radius(i) * relative_radius(i));
        return sum / static_cast<double>(end - begin);
    };
    const double first = photons.variance(0, 2, 0, 0, 64), late = photons.variance(0, 2, 0, 512, 1024);
    std::printf("variance %g to %g, expected %g\n", first, late, inverse(512, 1024) / inverse(0, 64));
    EXPECT_NEAR(std::log(late / first), std::log(inverse(512, 1024) / inverse(0, 64)),
                4.5 * std::hypot(std::sqrt(3.0 / 512.0), std::sqrt(3.0 / 64.0)));
}

}  // namespace neumann::photon_pictures_test
