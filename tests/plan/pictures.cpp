// What is left out changes no picture: not by a bit where the random numbers are the same, and elsewhere not beyond what chance
// does.
#include "tests/physics/pictures.h"
#include "core/reader/read_scene.h"
#include "operators/render/from_fields/field_rendering.h"
#include "operators/render/plan/plan.h"
#include "tests/physics/paths_of.h"
#include "tests/physics/seed.h"
#include "tests/plan/scenes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <functional>
#include <numeric>

namespace neumann::physics::pictures_test {

constexpr int bounces = 4;

Pictures rendered(const Scene& scene, const LeftOut& left_out, SamplerKind sampler, double rest,
                  const std::shared_ptr<const PathMethod>& method = plain_walks(), std::uint64_t replicates = 4) {
    return render(scene,
                  {.method = method,
                   .walk = {.bounces = bounces, .left_out = left_out, .rest_probability = rest, .give_up = 50},
                   .sampler = sampler,
                   .seed = fixed_seed,
                   .replicate_size = 8},
                  replicates);
}

bool same_bits(const Image& a, const Image& b) {
    return a.pixels.size() == b.pixels.size() && std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Rgb)) == 0;
}

void expect_same_bits(const Pictures& a, const Pictures& b) {
    for (std::size_t q = 0; q < a.result.quantities(); ++q)
        for (const auto read : {&SeriesMoments::Result::term, &SeriesMoments::Result::sum}) {
            EXPECT_TRUE(same_bits((a.result.*read)(q).mean, (b.result.*read)(q).mean)) << q;
            EXPECT_TRUE(same_bits((a.result.*read)(q).standard_error, (b.result.*read)(q).standard_error)) << q;
        }
    for (std::size_t q = 0; q < a.tally.largest.size(); ++q)
        EXPECT_EQ(a.tally.largest[q].sorted(), b.tally.largest[q].sorted()) << q;
    EXPECT_EQ(a.tally.given_up, b.tally.given_up);
}

std::uint64_t rays(const Pictures& p) { return std::accumulate(p.tally.rays.begin(), p.tally.rays.end(), std::uint64_t{0}); }

// Means over the picture, where what is left out draws other numbers: |z| ≤ 4.5 (7e-6 a comparison; quantities and channels of one
// scene go together, and there are four scenes).
void expect_agreement(const Pictures& a, const Pictures& b) {
    for (std::size_t q = 0; q < a.result.quantities(); ++q) {
        const MeanWithError x = a.result.mean_of_term(q), y = b.result.mean_of_term(q);
        const double error = std::hypot(x.standard_error, y.standard_error);
        EXPECT_LE(std::abs(x.mean - y.mean), 4.5 * error + 1e-13 * y.mean) << "quantity " << q;
        if (y.mean > 0.0) {
            EXPECT_LE(error, 0.05 * y.mean) << "quantity " << q;
        }
    }
}

void expect_the_same_pictures(const std::function<Scene()>& make) {
    const Scene whole = make();
    const Plan plan = make_plan(whole);
    const std::optional<Scene> reduced = without_unlit_materials(plan, whole);
    const Scene& scene = reduced ? *reduced : whole;
    const LeftOut& left_out = plan.walk;
    for (const SamplerKind sampler : {SamplerKind::independent, SamplerKind::sobol})
        for (const double rest : {0.0, 0.5}) {
            const Pictures all = rendered(whole, {}, sampler, rest);
            const Pictures planned = rendered(scene, left_out, sampler, rest);
            EXPECT_LE(rays(planned), rays(all));
            if (!left_out.light_samples) {
                expect_same_bits(planned, all);
                continue;
            }
            expect_agreement(planned, all);
            // All but this one.
            LeftOut others = left_out;
            others.light_samples = false;
            expect_same_bits(rendered(scene, others, sampler, rest), all);
        }
}

TEST(PlannedPicturesSlow, OfAllScenesThatComeAlong) {
    int count = 0;
    for (const auto& folder : std::filesystem::directory_iterator(SCENES)) {
        if (!folder.is_directory() || folder.path().filename() == "compare") continue;  // which has scripts for another renderer
        const std::string name = folder.path().filename();
        SCOPED_TRACE(name);
        expect_the_same_pictures([&] { return read_scene((folder.path() / (name + ".xml")).string(), {{"res", "12"}}); });
        ++count;
    }
    EXPECT_GE(count, 11);
}

Environment poles() {
    Image image(4, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Rgb(0.2 + 0.1 * static_cast<double>(i), 0.5, 1.0);
    return EnvironmentMap(image, 1.0, Mat4(1.0));
}

TEST(PlannedPictures, OfScenesThatNeedLittle) {
    const std::pair<const char*, std::function<Scene()>> scenes[] = {
        {"lit room",
         [] {
             return lit_room({0.7, 0.5, 0.3});
         }},
        {"grey lit room", [] { return lit_room(Rgb(0.6)); }},
        {"coloured furnace", [] { return coloured_furnace(); }},
        {"box under a constant sky", [] { return box_under(ConstantEnvironment(Rgb(0.8))); }},
        {"box under a picture of a sky", [] { return box_under(poles()); }},
        {"room lit by a point",
         [] {
             return point_lit_room({0.7, 0.5, 0.3});
         }},
        {"room with backs in the dark", [] { return room_from_behind(); }}};
    for (const auto& [name, make] : scenes) {
        SCOPED_TRACE(name);
        expect_the_same_pictures(make);
    }
}

// The other methods that walk take the same decisions, but for the kernels.
TEST(PlannedPictures, OfOtherMethods) {
    for (const Scene& scene : {lit_room({0.7, 0.5, 0.3}), box_under(poles()), point_lit_room({0.7, 0.5, 0.3})})
        for (const bool surface : {true, false}) {
            std::shared_ptr<const PathMethod> method = physics::paths_of(method::Classic{});
            if (surface) method = physics::paths_of(method::Surface{});
            LeftOut left_out = make_plan(scene).walk;
            expect_same_bits(rendered(scene, left_out, SamplerKind::sobol, 0.0, method),
                             rendered(scene, {}, SamplerKind::sobol, 0.0, method));
        }
}

// Each decision spares what it says, counted in rays of N + 1 bounces.
TEST(PlannedPictures, RaysThatAreSpared) {
    const auto count = [](const Scene& scene, const LeftOut& left_out, double rest = 0.0) {
        return rays(rendered(scene, left_out, SamplerKind::sobol, rest));
    };
    const Scene room = lit_room(Rgb(0.6));
    // One ray a bounce is left, and those between points that are within rounding of one plane.
    const double walked = 12.0 * 12.0 * 32.0 * (bounces + 1);
    const auto planned = static_cast<double>(count(room, make_plan(room).walk));
    EXPECT_GE(planned, walked);
    EXPECT_LE(planned, 1.0005 * walked);
    EXPECT_GE(static_cast<double>(count(room, {})), 1.3 * planned);

    const Scene box = box_under(poles());
    EXPECT_EQ(count(box, make_plan(box).walk), 12u * 12u * 32u);
    EXPECT_GT(count(box, {}), 12u * 12u * 32u);

    const Scene furnace = read_scene(SCENES "/furnace/furnace.xml", {{"res", "12"}});
    EXPECT_EQ(count(furnace, make_plan(furnace).walk), 12u * 12u * 32u * (bounces + 1));

    const Scene lamp = point_lit_room(Rgb(0.6));
    EXPECT_LT(count(lamp, make_plan(lamp).walk), count(lamp, {}));
    EXPECT_EQ(count(lamp, make_plan(lamp).walk, 0.5), count(lamp, {}, 0.5));
}

// On patches, sides where no light arrives have no unknowns and no rays, and the others are cut finer for it: other random numbers.
// The means of 64 repetitions of each bounce at |z| ≤ 4.5, to 2%.
TEST(PlannedPictures, OfFieldsWithSidesInTheDark) {
    const auto fields = [](const Scene& scene) {
        FieldSettings settings;
        settings.reading = FieldReading::matrix;
        settings.bounces = bounces;
        settings.patching.patches = 200;
        settings.replicates = 64;
        settings.seed = fixed_seed;
        return render_fields(scene, settings).value();
    };
    Scene scene = room_from_behind();
    // From before, where light is seen.
    scene.camera = looked_at(SceneMaker(), {4.0, 0.5, 0.3}, {0.0, 0.0, 0.0}).camera;
    const FieldPictures all = fields(scene);
    const Plan plan = make_plan(scene);
    ASSERT_FALSE(plan.sides.empty());
    const FieldPictures planned = fields(*without_unlit_materials(plan, scene));
    for (std::size_t i = 1; i <= bounces; ++i) {
        const MeanWithError x = planned.mean_of_term(i), y = all.mean_of_term(i);
        const double error = std::hypot(x.standard_error, y.standard_error);
        EXPECT_NEAR(x.mean, y.mean, 4.5 * error) << "bounce " << i;
        EXPECT_LE(error, 0.02 * y.mean) << "bounce " << i;
    }
}

// Bounces from 2 on are nothing, without error, and cost nothing.
TEST(PlannedPictures, OfAConvexObjectUnderASkyEndAfterBounceOne) {
    const Scene scene = box_under(poles());
    const Pictures planned = rendered(scene, make_plan(scene).walk, SamplerKind::sobol, 0.5);
    for (std::size_t q = 2; q < planned.result.quantities(); ++q) {
        EXPECT_EQ(planned.tally.rays[q], 0u);
        for (const Image& image : {planned.result.term(q).mean, planned.result.term(q).standard_error})
            for (const Rgb& x : image.pixels) EXPECT_EQ(x, Rgb(0.0));
    }
    EXPECT_GT(planned.result.mean_of_term(1).mean, 0.0);
    EXPECT_EQ(planned.tally.rays[1], 0u);
}

}  // namespace neumann::physics::pictures_test
