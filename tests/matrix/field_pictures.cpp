// Pictures read from fields against the walk, pixel by pixel: within noise and the error that the patches are said to make.
#include "operators/pictures/field_pictures.h"

#include "core/reader/read_scene.h"
#include "operators/pictures/render.h"
#include "operators/statistics/student_t.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>
#include <algorithm>
#include <atomic>

namespace neumann {
namespace {

RenderedSeries walk(const Scene& scene, int bounces, std::uint64_t samples) {
    PictureSampler::Settings settings;
    settings.walk.bounces = bounces;
    settings.walk.rest_probability = 0.0;
    settings.seed = 99;
    settings.replicate_size = replicate_size(samples);
    return render_series(scene, settings, {samples, {}, {}});
}

class FieldPicturesSlow : public testing::TestWithParam<std::tuple<FieldMethod, std::string>> {};

// In at least 95% of all pixels and channels of every bounce the difference is at most t · SE + discretisation, with the walk's own
// error in SE; and the mean of the reported discretisation error is at most 5 times that of the true error.
TEST_P(FieldPicturesSlow, AgreeWithTheWalk) {
    const auto& [method, name] = GetParam();
    const Scene scene = read_scene(fmt::format("{0}/{1}/{1}.xml", SCENES, name), {{"res", "48"}});
    constexpr int N = 4;
    const RenderedSeries truth = walk(scene, N, 4096);
    const auto walked = truth.moments.result();
    FieldSettings settings;
    settings.method = method;
    settings.bounces = N;
    settings.patching.patches = 3000;
    settings.rays = 64;
    settings.samples = 32;
    settings.gather_rays = 8;
    const FieldPictures found = *render_fields(scene, settings);
    const double t = student_t_quantile(0.95, settings.replicates - 1.0);
    for (int i = 0; i <= N; ++i) {
        const Estimate picture = found.term(static_cast<std::size_t>(i));
        const Estimate exact = walked.term(static_cast<std::size_t>(i));
        double within = 0.0, all = 0.0, reported = 0.0, error = 0.0;
        for (std::size_t pixel = 0; pixel < exact.mean.pixels.size(); ++pixel)
            for (int c = 0; c < 3; ++c) {
                const double difference = std::abs(picture.mean.pixels[pixel][c] - exact.mean.pixels[pixel][c]);
                const double noise = t * picture.standard_error.pixels[pixel][c] + 2.0 * exact.standard_error.pixels[pixel][c];
                within += difference <= noise + picture.discretisation.pixels[pixel][c] + 1e-15;
                all += 1.0;
                reported += picture.discretisation.pixels[pixel][c];
                error += difference;
            }
        EXPECT_GE(within / all, 0.95) << "bounce " << i;
        EXPECT_LE(reported, 5.0 * error + 1e-15) << "bounce " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(, FieldPicturesSlow,
                         testing::Combine(testing::Values(FieldMethod::matrix, FieldMethod::gather),
                                          testing::Values(std::string("cornell-box"), std::string("metal-room"),
                                                          std::string("glass-ball"))),
                         [](const auto& test) {
                             std::string name = std::get<1>(test.param);
                             std::replace(name.begin(), name.end(), '-', '_');
                             return (std::get<0>(test.param) == FieldMethod::matrix ? "matrix_" : "gather_") + name;
                         });

// Whoever has had enough waits for no step of it: the rays of T, the applications of K and the pixels all ask, and once one was
// told so, only those that run at the same time ask as well.
TEST(FieldPictures, AreGivenUpSoonAfterTheInterruption) {
    const Scene scene = read_scene(SCENES "/facing-mirrors/facing-mirrors.xml", {{"res", "16"}});
    FieldSettings settings;
    settings.patching.patches = 500;
    settings.replicates = 2;
    std::atomic<int> asked = 0;
    ASSERT_TRUE(render_fields(scene, settings, [&] {
        ++asked;
        return false;
    }));
    const int all = asked;
    EXPECT_GT(all, 50);
    for (const int patience : {0, 5, all / 4, all / 2, all - 40}) {
        asked = 0;
        EXPECT_FALSE(render_fields(scene, settings, [&] { return asked++ >= patience; })) << patience << " of " << all;
        EXPECT_LE(asked, patience + 1 + oneapi::tbb::this_task_arena::max_concurrency()) << patience << " of " << all;
    }
}

}  // namespace
}  // namespace neumann
