// More samples make no picture worse: eight million samples of a pixel are added up as exactly as a few.
#include "core/reader/read_scene.h"
#include "operators/experiments/known/scene_maker.h"
#include "operators/render/from_fields/field_rendering.h"
#include "operators/render/methods/method_options.h"
#include "operators/render/methods/render.h"
#include "tests/physics/today.h"

#include <gtest/gtest.h>

namespace neumann::many_samples_test {

using namespace known;

// A closed ball of albedo 0.7 that shines with radiance 1, seen from within: bounce i is 0.7^i everywhere.
constexpr double albedo = 0.7;
Scene furnace() {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, glowing(albedo, 1.0));
    maker.parts.camera.near_clip = 1e-3;
    Film& film = maker.parts.film;
    film.width = film.crop_width = film.height = film.crop_height = 1;
    film.filter = BoxFilter();
    return maker.make();
}

// Fields on patches are floats, but what pixels read of them is added up in doubles. A third of the methods a day, here and below.
TEST(ManySamplesSlow, OfFields) {
    const Scene scene = furnace();
    for (const FieldReading reading : {FieldReading::patches, FieldReading::matrix, FieldReading::gather}) {
        if (!physics::is_of_today(static_cast<std::size_t>(reading))) continue;
        FieldSettings settings;
        settings.reading = reading;
        settings.bounces = 2;
        settings.patching.patches = 60;
        settings.rays = 16;
        settings.replicates = 2;
        settings.rest = false;
        settings.gather_rays = 1;
        settings.samples = reading == FieldReading::gather ? 1u << 21 : 1u << 22;
        const FieldPictures found = *render_fields(scene, settings);
        for (std::size_t i = 0; i <= 2; ++i) {
            const double exact = std::pow(albedo, static_cast<double>(i));
            const MeanWithError mean = found.mean_of_term(i);
            // Bounce 1 asks lights at points of its own: one sample in two of them is 1/√n of it off.
            const double noise = i == 1 && reading != FieldReading::patches ? 4.5 * mean.standard_error + 2e-3 : 0.0;
            EXPECT_NEAR(mean.mean, exact, (noise + 3e-7) * exact) << static_cast<int>(reading) << ", bounce " << i;
        }
    }
}

// Sums in single precision would be 1% off after four million samples of a pixel, which is three standard errors here at least, and
// for most methods a thousand. 12 comparisons; |z| ≤ 4.5.
TEST(ManySamplesSlow, OfPaths) {
    const Scene scene = read_scene(SCENES "/furnace/furnace.xml", {{"res", "1"}, {"albedo", "0.7"}});
    std::size_t number = 0;
    for (const char* method : {"walk", "guided", "light", "bidirectional", "photon", "metropolis"}) {
        if (!physics::is_of_today(number++)) continue;
        Goal goal;
        goal.bounces = 1;
        goal.samples = 1u << 22;
        goal.replicates = 16;
        goal.only_pictures = true;
        const BounceSeries found = render(scene, read_method(method), goal);
        for (std::size_t i = 0; i <= 1; ++i) {
            const double exact = std::pow(albedo, static_cast<double>(i));
            const MeanWithError& mean = found.report.bounces[i].mean;
            // Every sample that the camera takes of the walls is 1, and powers of two of them are added up without rounding.
            if (i == 0 && method != std::string_view("light")) {
                EXPECT_EQ(mean.mean, 1.0) << method;
            }
            EXPECT_LE(mean.standard_error, 3.3e-3 * exact) << method << ", bounce " << i << ": no power";
            EXPECT_NEAR(mean.mean, exact, 4.5 * mean.standard_error + 1e-6 * exact) << method << ", bounce " << i;
        }
    }
}

}  // namespace neumann::many_samples_test
