// A method that is defined here alone: what a render, its report and its health ask of it, they ask by PathMethod.
#include "core/reader/read_scene.h"
#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/from_paths/term_estimators.h"
#include "operators/render/report/health.h"
#include "operators/render/report/least_errors.h"
#include "operators/render/report/remedy.h"
#include "operators/render/report/series_report.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace neumann::own_method_test {

// Le as it is seen, and nothing else.
class SeenLight : public TermEstimator {
public:
    explicit SeenLight(const Scene& scene) : scene_(scene) {}
    void operator()(std::span<const CameraRay> rays, std::span<Sampler>, Walkers& walkers, TermSamples& result) const override {
        WalkSettings settings;
        settings.bounces = static_cast<int>(result.rays.size()) - 2;
        start_walks(scene_, settings, rays, walkers, result);
    }
    void trace(PathObserver&, std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers& walkers,
               TermSamples& result) const override {
        (*this)(rays, samplers, walkers, result);
    }

private:
    const Scene& scene_;
};

class SeenPaths : public PathMethod {
public:
    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override {
        return std::make_shared<const EstimatorSampler>(scene, settings, std::make_unique<const SeenLight>(scene));
    }
    double walks_worth(int, std::span<const double>) const override { return 0.5; }
    bool has_rest() const override { return false; }
    bool is_bounded(const SamplingSettings&) const override { return true; }
    std::string why_no_balance() const override { return "nothing goes on"; }
    std::optional<std::vector<Remedy>> remedies(const Scene&, bool) const override { return {{Remedy::more_bounces}}; }
};

TEST(OwnMethod, IsRenderedAndExaminedAsAnyOther) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "16"}});
    SamplingSettings settings{.walk = {.bounces = 2, .rest_probability = 0.0}, .seed = physics::fixed_seed, .replicate_size = 4};
    const SamplingGoal goal{64, std::nullopt, std::nullopt};
    const auto of_walk = render_series(scene, settings, goal).moments.result();
    settings.method = std::make_shared<const SeenPaths>();
    const RenderedSeries series = render_series(scene, settings, goal);
    const auto result = series.moments.result();
    // The same camera rays see the same light.
    EXPECT_EQ(result.term(0).mean.pixels, of_walk.term(0).mean.pixels);
    for (const std::size_t bounce : {1, 2}) {
        EXPECT_EQ(result.mean_of_term(bounce).mean, 0.0);
        EXPECT_GT(of_walk.mean_of_term(bounce).mean, 0.0);
    }
    const Health health = examine(scene, settings, series, result);
    EXPECT_FALSE(health.is_sick());
    EXPECT_EQ(health.why_no_balance, "nothing goes on");
    ASSERT_TRUE(health.checkup);
    EXPECT_FALSE(health.checkup->camera || health.checkup->light);
    EXPECT_EQ(remedies(scene, PictureSampler(scene, settings), {0, 0}, 0), std::vector{Remedy::more_bounces});
    EXPECT_TRUE(report_series(scene, series, RestVerdict::not_sampled).bounces.size() == 3);
}

}  // namespace neumann::own_method_test
