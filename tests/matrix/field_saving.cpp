// Renders from fields that are kept at any moment and gone on with: the pictures are those of a render that was not cut.
#include "core/reader/read_scene.h"
#include "operators/render/from_fields/field_rendering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <string>

namespace neumann::field_saving_test {

// With numbers of its own, as it is read from a disk.
FieldProgress copy_of(const FieldProgress& progress) {
    FieldProgress copy = progress;
    for (SavedSeries& series : copy.series) {
        for (const std::span<const float> of : series.fields) series.numbers.insert(series.numbers.end(), of.begin(), of.end());
        series.fields.clear();
    }
    for (const FieldProgress::Read& read : copy.read) copy.values.insert(copy.values.end(), read.values.begin(), read.values.end());
    const float* next = copy.values.data();
    for (FieldProgress::Read& read : copy.read) {
        read.values = {next, read.values.size()};
        next += read.values.size();
    }
    return copy;
}

class FieldSavingTest : public testing::TestWithParam<const char*> {
protected:
    FieldSavingTest() : scene_(read_scene(std::string(SCENES) + "/" + GetParam() + "/" + GetParam() + ".xml", {{"res", "24"}})) {
        settings_.reading = FieldReading::gather;
        settings_.bounces = 3;
        settings_.patching.patches = 200;
        settings_.samples = 16;
    }

    // What is there when it was kept for the n-th time, and the render was stopped then; nothing if it ends before.
    std::optional<FieldProgress> stopped_at(int n, std::optional<FieldProgress> from = {}) const {
        std::atomic<bool> stop = false;
        std::optional<FieldProgress> kept;
        int times = 0;
        FieldSaving saving;
        saving.from = std::move(from);
        saving.is_due = [&](bool is_stopped) { return !is_stopped && !stop; };
        saving.keep = [&](FieldProgress& progress) {
            if (++times < n) return;
            kept = copy_of(progress);
            stop = true;
        };
        const auto found = render_fields(scene_, settings_, {.stop = [&] { return stop.load(); }}, nullptr, &saving);
        EXPECT_TRUE(found || stop);  // found in spite of a stop, if the last pixels were being read
        return kept;
    }
    FieldPictures rendered_from(FieldProgress progress) const {
        FieldSaving saving;
        saving.from = std::move(progress);
        saving.is_due = [](bool) { return false; };
        return render_fields(scene_, settings_, {}, nullptr, &saving).value();
    }
    static void expect_same(const FieldPictures& a, const FieldPictures& b) {
        EXPECT_EQ(a.rays, b.rays);
        EXPECT_EQ(a.rest_converges, b.rest_converges);
        EXPECT_EQ(a.power.begun.mean, b.power.begun.mean);
        for (std::size_t i = 0; i <= a.bounces(); ++i) {
            const Estimate x = a.term(i), y = b.term(i);
            EXPECT_TRUE(std::ranges::equal(x.mean.pixels, y.mean.pixels)) << i;
            EXPECT_TRUE(std::ranges::equal(x.standard_error.pixels, y.standard_error.pixels)) << i;
            EXPECT_TRUE(std::ranges::equal(x.discretisation.pixels, y.discretisation.pixels)) << i;
            EXPECT_EQ(a.mean_of_term(i).mean, b.mean_of_term(i).mean) << i;
            EXPECT_EQ(a.mean_of_term(i).standard_error, b.mean_of_term(i).standard_error) << i;
        }
    }
    static std::size_t amount(const FieldProgress& progress) {
        return std::accumulate(progress.read.begin(), progress.read.end(), 1000 * progress.series.size(),
                               [](std::size_t sum, const FieldProgress::Read& read) { return sum + (read.end - read.begin); });
    }

    Scene scene_;
    FieldSettings settings_;
};

TEST_P(FieldSavingTest, GoesOnFromAnyMoment) {
    const FieldPictures whole = render_fields(scene_, settings_).value();
    std::size_t with_pixels = 0;
    for (const int n : {1, 3, 4, 5, 7, 9}) {
        SCOPED_TRACE(n);
        const auto kept = stopped_at(n);
        ASSERT_TRUE(kept);
        with_pixels += !kept->read.empty();
        expect_same(rendered_from(*kept), whole);
        // Once more from there: what is kept then is not less.
        if (const auto more = stopped_at(1, copy_of(*kept))) {
            EXPECT_GE(amount(*more), amount(*kept));
            expect_same(rendered_from(*more), whole);
        }
    }
    EXPECT_GE(with_pixels, 2u);
}

// A render that is stopped before it has taken all that was there does not replace it by less.
TEST_P(FieldSavingTest, KeepsNothingThatIsLess) {
    const auto kept = stopped_at(9);
    ASSERT_TRUE(kept);
    for (int patience = 0; patience < 12; patience += 3) {
        std::atomic<int> asked = 0;
        FieldSaving saving;
        saving.from = copy_of(*kept);
        saving.is_due = [](bool) { return true; };
        saving.keep = [&](FieldProgress& progress) { EXPECT_GE(amount(progress), amount(*kept)); };
        const auto found = render_fields(scene_, settings_, {.stop = [&] { return ++asked > patience; }}, nullptr, &saving);
        EXPECT_FALSE(found) << patience;
    }
}

TEST_P(FieldSavingTest, RefusesWhatIsNotOfTheScene) {
    const auto kept = stopped_at(9);
    ASSERT_TRUE(kept);
    FieldProgress other = copy_of(*kept);
    other.series.front().numbers.pop_back();
    EXPECT_THROW(rendered_from(std::move(other)), RunError);
    other = copy_of(*kept);
    other.read.back().end += 1;
    EXPECT_THROW(rendered_from(std::move(other)), RunError);
    // Of other settings, it is not taken.
    other = copy_of(*kept);
    other.settings.seed = 7;
    expect_same(rendered_from(std::move(other)), render_fields(scene_, settings_).value());
}

INSTANTIATE_TEST_SUITE_P(Scenes, FieldSavingTest, testing::Values("cornell-box", "glass-ball"), [](const auto& info) {
    std::string name = info.param;
    std::erase(name, '-');
    return name;
});

}  // namespace neumann::field_saving_test
