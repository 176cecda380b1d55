// Pictures by photon maps beside those of walks and closed forms, bounce by bounce: they differ by no more than their standard
// errors and their estimated bias say, and both fall with the number of passes as theory has it.
#include "core/reader/read_scene.h"
#include "operators/methods/method_options.h"
#include "operators/statistics/student_t.h"
#include "tests/physics/picture_blocks.h"
#include "tests/physics/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace neumann::photon_pictures_test {

using physics::Blocks;
using physics::fixed_seed;
using physics::settings_of;

struct Case {
    const char* scene;
    const char* reference;  // a method that makes all its paths well
    std::uint64_t replicates;
    bool rest;  // whether the reference knows the rest, which walks from the camera measure
};

// |photon − reference| ≤ t SE + bias in 95% of all blocks, bounces and channels, and in 90% of those of a scene; and nowhere
// farther off than 4.5 SE + 2 bias. Blocks that the reference does not know to 2% are left out. Values of a scene go together (the
// channels have the same photons, and neighbours share some), so that 150 of them are about as many as 50: 90% leaves 1.6 standard
// deviations of their number, with intervals that are wider than 95% by the bias. Passed over five seeds.
TEST(PhotonPicturesSlow, AreWithinTheirStatedErrors) {
    int within_all = 0, all = 0;
    for (const Case& c : {Case{"cornell-box", "walk", 64, true}, Case{"glass-ball", "bidirectional", 512, false},
                          Case{"door-ajar", "bidirectional", 256, true}, Case{"glossy-floor", "walk", 128, true},
                          Case{"metal-room", "bidirectional", 256, true}, Case{"facing-mirrors", "walk", 128, true},
                          Case{"outdoor", "bidirectional", 256, true}}) {
        const Scene scene = read_scene(fmt::format(SCENES "/{}/{}.xml", c.scene, c.scene), {{"res", "32"}});
        constexpr std::size_t bounces = 4;
        const Blocks reference(scene, settings_of(scene, make_method({c.reference, {}}), bounces, fixed_seed, 0.5), 8,
                               c.replicates);
        for (const char* gather : {"false", "true"}) {
            const SamplingSettings settings = settings_of(
                scene, make_method({"photon", {{"gather", gather}, {"photons", "16384"}}}), bounces, fixed_seed + 1, 0.5);
            const Blocks photons(scene, settings, 8, 128);
            int within = 0, count = 0;
            for (std::size_t q = 0; q <= bounces + (c.rest ? 1 : 0); ++q)
                for (std::size_t b = 0; b < photons.blocks(); ++b)
                    for (std::size_t channel = 0; channel < 3; ++channel) {
                        const auto p = photons.at(b, q, channel, photons.replicates()),
                                   r = reference.at(b, q, channel, c.replicates);
                        if (r.mean == 0.0 || r.error > 0.02 * r.mean) continue;
                        const double error = std::hypot(p.error, r.error), off = std::abs(p.mean - r.mean);
                        within += off <= student_t_quantile(0.95, 127.0) * error + p.bias;
                        EXPECT_LE(off, 4.5 * error + 2.0 * p.bias)
                            << c.scene << ", gather " << gather << ", bounce " << q << ", block " << b << ", channel " << channel
                            << ": " << p.mean << " ± " << p.error << " and bias " << p.bias << ", " << r.mean << " ± " << r.error;
                        ++count;
                    }
            std::printf("%s, gather %s: %d of %d within\n", c.scene, gather, within, count);
            EXPECT_GE(within, 0.9 * count) << c.scene << ", gather " << gather;
            EXPECT_GE(count, 30) << c.scene;
            within_all += within;
            all += count;
        }
    }
    std::printf("%d of %d within\n", within_all, all);
    EXPECT_GE(within_all, 0.95 * all);
}

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
