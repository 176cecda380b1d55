// The scenes that come along render, and give the answers that their READMEs state.
#include "tests/commands/render_output.h"

#include <algorithm>

namespace neumann::render_scenes_test {

class RenderScenes : public RenderTest {
protected:
    // Means of the picture against a table of bounces 0 … 8, three channels each, with a standard error of their own where they
    // come from another tracer: 27 comparisons, false alarm 2·10⁻⁴. A mean over the picture does not depend on the number of its
    // pixels.
    void expect_means(const std::string& scene, const std::vector<std::array<double, 6>>& known, double visible) const {
        render(scene_file(scene), "a", {"-D", "res=16", "-n", "8", "--spp", "512", "--quiet"});
        expect_complete("a");
        expect_finite("a");
        for (int i = 0; i < static_cast<int>(known.size()); ++i) {
            const Estimate bounce = picture("a", numbered("bounce", i));
            for (int c = 0; c < 3; ++c) {
                const ChannelMean mean = channel_mean(bounce, c);
                const double error = std::hypot(mean.standard_error, known[i][c + 3]);
                EXPECT_LE(std::abs(mean.mean - known[i][c]), 4.5 * error) << "bounce " << i << ", channel " << c;
                if (i > 0) {
                    EXPECT_LE(error, visible * known[i][c]) << "what this test can see; bounce " << i << ", channel " << c;
                }
            }
        }
    }
};

// Exact where the material's directions alone are sampled, up to the float32 of the file; every channel with a ρ of its own.
TEST_F(RenderScenes, FurnaceIsExact) {
    const Rgb rho(0.25, 0.5, 0.75);
    render(scene_file("furnace"), "a",
           {"-D", "res=16", "-D", "albedo=.25,.5,.75", "-n", "8", "--spp", "4", "--direct", "bsdf", "--quiet"});
    Rgb power(1.0), sum(0.0);
    for (int i = 0; i <= 8; ++i, power *= rho) {
        sum += power;
        const Estimate bounce = picture("a", numbered("bounce", i)), sums = picture("a", numbered("sum", i));
        for (std::size_t p = 0; p < bounce.mean.pixels.size(); ++p)
            for (int c = 0; c < 3; ++c) {
                EXPECT_EQ(bounce.mean.pixels[p][c], static_cast<double>(static_cast<float>(power[c]))) << i;
                EXPECT_NEAR(sums.mean.pixels[p][c], sum[c], 0x1p-24 * sum[c]) << i;
                EXPECT_LE(bounce.standard_error.pixels[p][c], 8 * i * 0x1p-52 * power[c]) << i;
            }
    }
    EXPECT_EQ(warnings("a"), (std::map<std::string, int>()));
}

// In every pixel, also where wall and disk share it, bounce i is s + (d − s) × bounce 0; here of the means of the pictures. 8
// bounces of two kinds of sampling, |z| ≤ 4.5 with the errors of both bounces added: a false alarm is rarer than 10⁻⁴.
TEST_F(RenderScenes, SphereSegmentIsATwoByTwoSystem) {
    for (const char* direct : {"mis", "bsdf"}) {
        render(scene_file("sphere-segment"), direct, {"-D", "res=16", "-n", "8", "--spp", "512", "--direct", direct, "--quiet"});
        const ChannelMean shared = channel_mean(picture(direct, "bounce_000.exr"), 0);
        EXPECT_GT(shared.mean, 0.05);
        double s = 0.0, d = 1.0;
        for (int i = 1; i <= 8; ++i) {
            const double from_disk = d;
            d = 0.7 * s;
            s = 0.5 * (0.75 * s + 0.25 * from_disk);
            const ChannelMean mean = channel_mean(picture(direct, numbered("bounce", i)), 0);
            const double error = mean.standard_error + std::abs(d - s) * shared.standard_error;
            EXPECT_LE(std::abs(mean.mean - (s + (d - s) * shared.mean)), 4.5 * error) << direct << ' ' << i;
            EXPECT_LE(error, 0.03 * mean.mean) << "what this test can see; bounce " << i;
        }
    }
    EXPECT_EQ(warnings("mis"), (std::map<std::string, int>()));
}

TEST_F(RenderScenes, CornellBox) {
    constexpr double light = 0.005893481;
    expect_means("cornell-box",
                 {{light * 20.7113, light * 10.8546, light * 2.77115},
                  {0.053612, 0.0270904, 0.00584339, 9.8e-6, 4.8e-6, 1.2e-6},
                  {0.0263715, 0.0132278, 0.00256801, 8.9e-6, 4.9e-6, 1.2e-6},
                  {0.0127978, 0.00623517, 0.00106614, 5.6e-6, 2.8e-6, 6.6e-7},
                  {0.00589461, 0.00286773, 0.000414496, 3.1e-6, 1.7e-6, 3.7e-7},
                  {0.00304699, 0.00147398, 0.000192508, 1.8e-6, 8.4e-7, 1.9e-7},
                  {0.00150529, 0.000728517, 8.08216e-5, 1.1e-6, 4.2e-7, 8.9e-8},
                  {0.000793164, 0.000382125, 3.83972e-5, 6.2e-7, 2.4e-7, 4.6e-8},
                  {0.000410527, 0.000196689, 1.71502e-5, 3.8e-7, 1.9e-7, 3.6e-8}},
                 0.05);
}

TEST_F(RenderScenes, MitsubaCornell) {
    expect_means("mitsuba-cornell",
                 {{0.108167, 0.0646361, 0.0161987},
                  {0.054914, 0.024646, 0.00543014, 1.1e-5, 4.6e-6, 1.4e-6},
                  {0.0251185, 0.00834497, 0.00258166, 8.3e-6, 2.8e-6, 1.5e-6},
                  {0.0135792, 0.00348776, 0.00100185, 4.5e-6, 1.2e-6, 6.3e-7},
                  {0.00643541, 0.00127842, 0.000400994, 2.7e-6, 5.7e-7, 3.9e-7},
                  {0.00353619, 0.000549939, 0.000181274, 1.9e-6, 2.7e-7, 1.8e-7},
                  {0.00182777, 0.000220816, 7.76302e-5, 1.1e-6, 1.3e-7, 1.1e-7},
                  {0.00100983, 9.46355e-5, 3.6856e-5, 7.5e-7, 7.1e-8, 6.9e-8},
                  {0.000546523, 3.95155e-5, 1.67606e-5, 4.9e-7, 3.4e-8, 3.6e-8}},
                 0.05);
}

TEST_F(RenderScenes, MetalRoom) {
    render(scene_file("metal-room"), "a", {"-D", "res=128", "-n", "2", "--spp", "64", "--quiet"});
    expect_finite("a");
    const ChannelMean lamp = channel_mean(picture("a", "bounce_000.exr"), 1);
    EXPECT_LE(std::abs(lamp.mean - 0.1107909), 4.5 * lamp.standard_error);
    EXPECT_LE(lamp.standard_error, 0.005 * lamp.mean);
    // The lamp's image covers this row, from 34/128 = 0.266 to 35/128 = 0.273, from 0.431 to 0.569.
    const Estimate bounce = picture("a", "bounce_001.exr");
    for (int x = 56; x < 72; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(34 * 128 + x);
        EXPECT_NEAR(bounce.mean.pixels[pixel].g, 9.0, 1e-6) << x;
        EXPECT_LE(bounce.standard_error.pixels[pixel].g, 1e-6) << x;
    }
}

// What their READMEs say of bounce 0, and of the lamp's mirror image. More of those of lectures is in tests/python.
TEST_F(RenderScenes, HardOnes) {
    const Names hidden_lights{"door-ajar", "fixtures", "four-floors", "glass-ball", "lid", "pool"};
    for (const char* scene : {"courtyard", "door-ajar", "facing-mirrors", "fixtures", "floating-panels", "four-floors",
                              "glass-ball", "glossy-floor", "lid", "outdoor", "pool", "six-materials", "street"}) {
        render(scene_file(scene), scene, {"-D", "res=128", "-n", "3", "--spp", "4", "--quiet"});
        expect_complete(scene);
        expect_finite(scene);
        const ChannelMean emitted = channel_mean(picture(scene, "bounce_000.exr"), 0);
        EXPECT_EQ(emitted.mean == 0.0, hidden_lights.contains(scene)) << scene;
        for (int i = 1; i <= 3; ++i) EXPECT_GT(channel_mean(picture(scene, numbered("bounce", i)), 0).mean, 0.0) << scene << i;
    }
    double brightest = 0.0;
    const Estimate mirrored = picture("facing-mirrors", "bounce_001.exr");
    for (const Rgb& p : mirrored.mean.pixels) brightest = std::max(brightest, p.r);
    EXPECT_NEAR(brightest, 0.9 * 14.0, 1e-5);
}

// Every folder in scenes/ has a scene of its name, which is rendered above or here; compare has scripts for another renderer.
TEST_F(RenderScenes, NoneIsForgotten) {
    Names found;
    for (const auto& entry : std::filesystem::directory_iterator(SCENES))
        if (entry.is_directory()) found.insert(entry.path().filename().string());
    EXPECT_EQ(found.erase("compare"), 1u);
    EXPECT_EQ(found, (Names{"cornell-box", "courtyard", "door-ajar", "facing-mirrors", "fixtures", "floating-panels", "four-floors",
                            "furnace", "glass-ball", "glossy-floor", "lid", "metal-room", "mitsuba-cornell", "outdoor", "pool",
                            "six-materials", "sphere-segment", "street"}));
    for (const std::string& name : found) EXPECT_TRUE(std::filesystem::exists(scene_file(name))) << name;
}

}  // namespace neumann::render_scenes_test
