// From runs and their pictures to points and ranks, with pictures whose errors are known.
#include "operators/experiments/study/study_points.h"

#include <gtest/gtest.h>

#include <array>

namespace neumann::study_points_test {

// Two methods, two budgets in seconds, one pixel; the reference is exactly 1 in bounce 0 and in the sum.
struct SmallStudy {
    StudyPlan plan{{1.0, 2.0}, false, {{{1}, {2}}, {{1}, {2}}}, 0};
    std::vector<Estimate> reference;
    std::vector<StudyRun> runs;

    explicit SmallStudy(std::size_t repeats) {
        Image one(1, 1);
        one.pixels[0] = Rgb(1.0);
        reference.assign(2, {one, {}});
        for (std::size_t n = 0; n < 4 * repeats; ++n) {
            const auto [method, budget, repeat] = place_of_run(n, plan);
            StudyRun& run = runs.emplace_back();
            run.method = method;
            run.budget = budget;
            run.repeat = repeat;
            run.samples = budget + 1;
            run.seconds = plan.budgets[budget] * (method == 1 ? 1.2 : 1.0);
            run.rays.assign(1, 10 * (n + 1));
            run.peak_memory = static_cast<double>(n);
            run.mean = {1.0, 1.0};
            run.variance = std::string(1, method == 1 && repeat == 0 ? 'i' : 'f');
        }
    }
    // ±d in turn: method 0 has d = 0.1, method 1 d = 0.4.
    Image picture(std::size_t n) const {
        Image image(1, 1);
        image.pixels[0] = Rgb(1.0 + (runs[n].repeat % 2 ? 1.0 : -1.0) * (runs[n].method == 0 ? 0.1 : 0.4));
        return image;
    }
    std::vector<StudyPoint> points() const {
        return study_points(runs, plan, reference, [&](std::size_t n, std::size_t) { return picture(n); });
    }
};

TEST(StudyPoints, EveryRepeatHasAllMethodsAndBudgets) {
    const SmallStudy study(2);
    std::vector<std::array<std::size_t, 3>> places;
    for (const StudyRun& run : study.runs) places.push_back({run.method, run.budget, run.repeat});
    EXPECT_EQ(places, (std::vector<std::array<std::size_t, 3>>{
                          {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}));
}

TEST(StudyPoints, TakeAtLeastTwoRepeats) {
    EXPECT_TRUE(SmallStudy(1).points().empty());
    SmallStudy study(2);
    study.runs.pop_back();  // the second method has the larger budget once
    const auto points = study.points();
    ASSERT_EQ(points.size(), 3u);
    EXPECT_EQ(points_of_method(points, 0).size(), 2u);
    EXPECT_EQ(points_of_method(points, 1).size(), 1u);
    EXPECT_TRUE(summarise({}, study.plan, study.reference, std::nullopt).empty());
}

TEST(StudyPoints, ErrorsAndCostsAreThoseOfTheRuns) {
    const SmallStudy study(4);
    const auto points = study.points();
    ASSERT_EQ(points.size(), 4u);
    for (const StudyPoint& point : points) {
        const double d = point.method() == 0 ? 0.1 : 0.4;
        for (const ErrorStatistics& errors : point.errors) EXPECT_NEAR(errors.mean_mse.value, d * d, 1e-7);
        EXPECT_EQ(missed_budget(study.plan, point).has_value(), point.method() == 1);
        EXPECT_FALSE(point.mean_discretisation(0).has_value());
        EXPECT_FALSE(point.infinite_variance(0));  // one run of four says so
    }
    // Runs 0, 4, 8 and 12.
    EXPECT_EQ(points[0].mean_rays(0), 10.0 * (1 + 5 + 9 + 13) / 4.0);
    EXPECT_EQ(points[0].mean_rays(1), points[0].mean_rays(0));
    EXPECT_EQ(points[0].largest_memory(), 12.0);
}

TEST(StudyPoints, TheMethodWithLessErrorInLessTimeIsFirst) {
    const SmallStudy study(4);
    const auto pictures = summarise(study.points(), study.plan, study.reference, 0.5);
    ASSERT_EQ(pictures.size(), 2u);
    for (const StudiedPicture& picture : pictures) {
        EXPECT_EQ(picture.reference_size, 1.0);
        EXPECT_EQ(picture.reference_noise, 0.0);
        EXPECT_EQ(picture.error, 0.5);
        ASSERT_EQ(picture.methods.size(), 2u);
        EXPECT_EQ(picture.methods[0].method, 0u);
        EXPECT_EQ(picture.methods[1].method, 1u);
        EXPECT_NEAR(picture.methods[0].summary.points[1].rmse.value, 0.1, 1e-7);
        EXPECT_NEAR(picture.methods[1].summary.points[1].rmse.value, 0.4, 1e-7);
    }
}

}  // namespace neumann::study_points_test
