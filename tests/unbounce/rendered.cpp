// Scenes rendered under a projector's lights: the inverse series beside the forward one, and what breaks it. Comparisons are of
// means and pass at 4.5 standard errors: a false alarm in 147 000 each, of which there are about 60. The seeds are fixed.
#include "core/reader/read_scene.h"
#include "operators/experiments/unbounce/doubts.h"
#include "operators/experiments/unbounce/light_renders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace neumann::unbounce_rendered_test {

using Kind = Doubt::Kind;

constexpr int bounces = 4;

struct Rendered {
    int columns, rows;
    LightRenders renders;

    Rendered(const std::string& left, int columns_, int rows_, int width, std::uint64_t samples, std::uint64_t seed)
        : columns(columns_), rows(rows_) {
        const Scene scene = read_scene(SCENES "/../notebooks/corner.xml", {{"left", left}});
        const ProjectorLights projector(scene, width, columns, rows);
        renders = render_lights(projector, {bounces, samples, seed}, {}, [](double) {});
    }

    LightPictures pictures() const {
        LightPictures result;
        for (std::size_t j = 0; j < renders.pictures.size(); ++j) result.names.push_back("light " + std::to_string(j));
        result.picture = [this](std::size_t j) { return renders.pictures[j]; };
        result.direct = [this](std::size_t j) { return renders.direct_of(j); };
        result.parts = &renders.parts;
        return result;
    }
    Unbounced unbounced(bool with_direct) const {
        return unbounce(pictures(), renders.parts.regions, nullptr,
                        {.bounces = bounces, .with_direct = with_direct, .merged = merged_by_four(columns, rows)});
    }
};

const Rendered& corner() {
    static const Rendered rendered("diffuse", 8, 8, 24, 64, 1);
    return rendered;
}

std::vector<Kind> kinds(const std::vector<Doubt>& doubts) {
    std::vector<Kind> result;
    for (const Doubt& doubt : doubts) result.push_back(doubt.kind);
    return result;
}
std::string words(const std::vector<Doubt>& doubts) {
    std::string text;
    for (const Doubt& doubt : doubts) text += doubt.words + "\n";
    return text;
}
bool has(const std::vector<Doubt>& doubts, Kind kind) {
    const auto all = kinds(doubts);
    return std::find(all.begin(), all.end(), kind) != all.end();
}

// A light shines on the pixels of its block and on no others, and all together as the whole projector.
TEST(UnbounceRendered, LightsAreTheProjectorInParts) {
    const Rendered& rendered = corner();
    for (std::size_t j = 0; j < rendered.renders.pictures.size(); ++j)
        for (std::size_t p = 0; p < rendered.renders.parts.regions.of_pixel.size(); ++p)
            if (rendered.renders.parts.regions.of_pixel[p] != static_cast<int>(j)) {
                EXPECT_EQ(rendered.renders.direct_of(j).mean.pixels[p], Rgb(0.0)) << j << " " << p;
            }
    // The means, with the errors of both: pixels that edges cross are noisy.
    const MeanWithError parts = picture_mean(rendered.renders.direct), whole = picture_mean(rendered.renders.forward[0]);
    const double error = std::hypot(parts.standard_error, whole.standard_error);
    EXPECT_LT(std::abs(parts.mean - whole.mean), 4.5 * error);
    EXPECT_LT(error, 0.004 * whole.mean) << "a block that is one pixel off has 4%";
}

TEST(UnbounceRendered, AgreesWithTheForwardSeries) {
    for (const bool with_direct : {false, true}) {
        const Unbounced found = corner().unbounced(with_direct);
        const std::vector<TermAgreement> forward = agreement(found, corner().renders.forward);
        ASSERT_EQ(forward.size(), std::size_t{bounces});
        for (const TermAgreement& term : forward) {
            EXPECT_LT(std::abs(term.deviations()), 4.5);
            EXPECT_LT(term.difference.standard_error, 0.04 * term.forward.mean) << "or the test sees nothing";
            EXPECT_LT(term.discretisation, 0.4 * term.forward.mean) << "as measured in the manual: 0.24 in bounce 4";
        }
        const std::vector<Doubt> doubts = doubts_about(found, corner().pictures().names, forward);
        EXPECT_TRUE(doubts.empty()) << words(doubts);
    }
}

TEST(UnbounceRendered, MoreLightsComeCloser) {
    std::map<int, double> error;
    for (const int lights : {4, 8}) {
        const Rendered rendered("diffuse", lights, lights, 24, 64, 1);
        error[lights] = agreement(rendered.unbounced(false), rendered.renders.forward)[1].relative_difference;
    }
    EXPECT_LT(error[8], 0.8 * error[4]);
}

TEST(UnbounceRendered, AMirrorIsFoundOut) {
    const Rendered rendered("mirror", 8, 8, 24, 64, 1);
    const Unbounced found = rendered.unbounced(false);
    const std::vector<Doubt> doubts = doubts_about(found, rendered.pictures().names);
    EXPECT_TRUE(has(doubts, Kind::unlit)) << words(doubts);
    const std::vector<Doubt> with_forward =
        doubts_about(found, rendered.pictures().names, agreement(found, rendered.renders.forward));
    EXPECT_TRUE(has(with_forward, Kind::differs)) << words(with_forward);
}

// Half of the lights are not there: the other half of the picture is lit by what the first reflects. Direct pictures show it;
// without them, what a dark pixel gets from the region that shines on it most passes for direct light.
TEST(UnbounceRendered, LightsThatDoNotCoverWhatIsSeen) {
    LightPictures some = corner().pictures();
    std::vector<std::size_t> left;
    for (std::size_t j = 0; j < some.names.size(); ++j)
        if (j % 8 < 4) left.push_back(j);
    for (auto* pictures : {&some.picture, &some.direct})
        *pictures = [all = *pictures, left](std::size_t j) { return all(left[j]); };
    some.names.resize(left.size());
    const Unbounced found = unbounce(some, brightest_regions(some), nullptr, {.bounces = bounces, .with_direct = true});
    const std::vector<Doubt> doubts = doubts_about(found, some.names);
    EXPECT_TRUE(has(doubts, Kind::unlit)) << words(doubts);
}

TEST(UnbounceRendered, NoiseIsSaid) {
    const Rendered rendered("diffuse", 8, 8, 16, 2, 1);
    const std::vector<Doubt> doubts = doubts_about(rendered.unbounced(false), rendered.pictures().names);
    EXPECT_TRUE(has(doubts, Kind::noise) || has(doubts, Kind::singular)) << words(doubts);
}

// A light that shines on the regions of others, too: here the first is the sum of two.
TEST(UnbounceRendered, OverlappingLightsAreFoundOut) {
    LightPictures lights = corner().pictures();
    const auto sum = [](const std::function<Estimate(std::size_t)>& picture_of) {
        return [picture_of](std::size_t j) {
            Estimate picture = picture_of(j);
            if (j != 27) return picture;
            const Estimate other = picture_of(28);
            for (std::size_t p = 0; p < picture.mean.pixels.size(); ++p) picture.mean.pixels[p] += 0.5 * other.mean.pixels[p];
            return picture;
        };
    };
    lights.picture = sum(lights.picture);
    lights.direct = sum(lights.direct);
    const Unbounced found = unbounce(lights, corner().renders.parts.regions, nullptr, {.bounces = bounces});
    const std::vector<Doubt> doubts = doubts_about(found, lights.names);
    EXPECT_TRUE(has(doubts, Kind::shared_light)) << words(doubts);
}

TEST(UnbounceRendered, CamerasThatAreNoProjectorsAreRefused) {
    const Scene scene = read_scene(SCENES "/../notebooks/corner.xml");
    const auto refused = [&](int width, int columns) {
        try {
            const ProjectorLights lights(scene, width, columns, columns);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(refused(8, 9), "9×9 lights for pictures of 8×8 pixels, expected at most one a pixel");
    Film cropped = scene.film;
    cropped.crop_width = 10;
    const Scene part = scene.with(cropped);
    EXPECT_THROW(ProjectorLights(part, 8, 2, 2), InputError);
}

}  // namespace neumann::unbounce_rendered_test
