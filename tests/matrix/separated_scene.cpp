// A scene with T, R and Le apart: changed, it is the changed scene separated anew, bit by bit; and its series is that of other
// code.
#include "operators/fields/matrix/separated_scene.h"

#include "core/base/error.h"
#include "operators/fields/matrix/traced_system.h"
#include "operators/render/methods/render.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace neumann::separated_scene_test {

using namespace physics;

const Rgb white(0.7, 0.7, 0.7), red(0.6, 0.1, 0.05), warm(5.0, 4.0, 2.0);

Surface painted(const Rgb& rho) { return made_of(Diffuse(rho)); }
Surface shining(const Rgb& radiance) { return {std::nullopt, AreaLight{radiance}}; }

// A closed box of edge 2 with two lamps below its ceiling, seen from inside.
Scene room_of(const Rgb& walls, const Rgb& left_wall, const Rgb& lamp, const Rgb& other_lamp) {
    SceneMaker maker;
    const auto faces = room(Vec3(-1.0), Vec3(1.0));
    for (std::size_t i = 0; i < faces.size(); ++i) maker.add(faces[i], painted(i == left ? left_wall : walls));
    maker.add(patch(Vec3(-0.4, 0, 0.9), Vec3(0, 0, -1), 0.2), shining(lamp));
    maker.add(patch(Vec3(0.5, 0.3, 0.9), Vec3(0, 0, -1), 0.1), shining(other_lamp));
    maker.parts.film.width = maker.parts.film.height = 48;
    maker.parts.film.crop_width = maker.parts.film.crop_height = 48;
    // From the front, along y.
    maker.parts.camera = {
        .to_world = Mat4({-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, -0.9, 0, 1}), .fov = 0.5 * pi, .near_clip = 1e-3};
    return maker.make();
}

const SeparatingSettings few{.patches = 300, .rays = 64, .camera_rays = 4, .pixels = 24 * 24};

double mean(const std::vector<Rgb>& picture) {
    double sum = 0.0;
    for (const Rgb& c : picture) sum += mean_component(c);
    return sum / static_cast<double>(picture.size());
}

void expect_same(const SeparatedScene& a, const SeparatedScene& b) {
    const auto of_a = pictures_of_series(a, 6), of_b = pictures_of_series(b, 6);
    for (std::size_t i = 0; i < of_a.size(); ++i)
        for (std::size_t p = 0; p < of_a[i].size(); ++p)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(of_a[i][p][c], of_b[i][p][c], 1e-12 * std::abs(of_b[i][p][c])) << "bounce " << i << ", pixel " << p;
}

TEST(SeparatedScene, OfAChangedMaterialNeedsNoRay) {
    SeparatedScene scene = separate(room_of(white, white, warm, Rgb(3.0)), few);
    ASSERT_EQ(scene.materials.size(), 7u);  // of six walls, and of the lamps, which are black
    // The left wall is the first shape.
    const std::uint32_t left_wall = scene.facets.front().material;
    for (SeparatedScene::Facet& facet : scene.facets)
        if (facet.material == left_wall) facet.reflectance = red;
    expect_same(scene, separate(room_of(white, red, warm, Rgb(3.0)), few));
}

TEST(SeparatedScene, OfAChangedLampNeedsNoRay) {
    SeparatedScene scene = separate(room_of(white, red, Rgb(1.0), Rgb(2.0)), few);
    ASSERT_EQ(scene.lamps.size(), 2u);
    for (std::vector<Rgb>* field : {&scene.lamps[0].emitted, &scene.lamps[0].arriving})
        for (Rgb& value : *field) value *= warm;
    expect_same(scene, separate(room_of(white, red, warm, Rgb(2.0)), few));
}

// In a closed room all rays see something: K 1 = ρ.
TEST(SeparatedScene, LosesWhatItsSurfacesAbsorb) {
    SceneMaker maker;
    const auto faces = room(Vec3(-1.0), Vec3(1.0));
    for (std::size_t i = 0; i < faces.size(); ++i) maker.add(faces[i], i == ceiling ? glowing(0.25, 1.0) : matte(0.5));
    const SeparatedScene scene = separate(maker.make(), few);
    EXPECT_EQ(scene.seen.size(), scene.facets.size() * scene.rays);
    for (const std::uint32_t g : scene.seen) ASSERT_LT(g, scene.facets.size());
    for (std::size_t f = 0; f < scene.facets.size(); ++f)
        EXPECT_EQ(scene.facets[f].reflectance, Rgb(is_black(scene.lamps[0].emitted[f]) ? 0.5 : 0.25)) << f;
}

// The means of pictures against `walk`, which has no patches: within its errors and a few percent of discretisation. The rays of
// 300 patches at 64 each leave a relative error below 1% in a mean; 5% are five times that.
TEST(SeparatedScene, AgreesWithWalks) {
    const Scene scene = room_of(white, red, warm, Rgb(3.0));
    SeparatingSettings settings = few;
    settings.camera_rays = 128;
    settings.patches = 4000;
    const auto pictures = pictures_of_series(separate(scene, settings), 4);
    Goal goal;
    goal.bounces = 4;
    goal.samples = 256;
    const BounceSeries walked = render(scene, method::Walk{}, goal);
    for (std::size_t i = 0; i <= 4; ++i) {
        const BounceReport& known = walked.report.bounces[i];
        EXPECT_NEAR(mean(pictures[i]), known.mean.mean, 0.02 * known.mean.mean + 4.5 * known.mean.standard_error) << "bounce " << i;
    }
}

TEST(SeparatedScene, JoinsPixelsByAWholeFactor) {
    const Scene scene = room_of(white, red, warm, Rgb(3.0));
    SeparatingSettings settings = few;
    settings.pixels = 17 * 17;
    const SeparatedScene joined = separate(scene, settings);
    EXPECT_EQ(joined.factor, 3);
    EXPECT_EQ(joined.width, 16);
    EXPECT_EQ(joined.camera.first.size(), 16u * 16u + 1);
    for (std::size_t p = 0; p < 16u * 16u; ++p) {
        double sum = 0.0;
        for (std::uint32_t e = joined.camera.first[p]; e < joined.camera.first[p + 1]; ++e) sum += joined.camera.weight[e];
        EXPECT_NEAR(sum, 1.0, 1e-9) << "in a closed room each pixel sees patches alone; pixel " << p;
    }
}

TEST(SeparatedScene, ManyLampsAreTheBrightestAndTheRest) {
    SceneMaker maker;
    for (const TriangleMesh& face : room(Vec3(-1.0), Vec3(1.0))) maker.add(face, matte(0.5));
    for (int k = 0; k < 40; ++k) maker.add(patch(Vec3(-0.9 + 0.045 * k, 0, 0.9), Vec3(0, 0, -1), 0.01), lamp(1.0 + k));
    const SeparatedScene scene = separate(maker.make(), few);
    ASSERT_EQ(scene.lamps.size(), 12u);
    EXPECT_EQ(scene.lamps.back().name, "the other 29 lamps");
    double all = 0.0;
    for (const SeparatedScene::Lamp& lamp : scene.lamps)
        for (std::size_t f = 0; f < scene.facets.size(); ++f) all += lamp.emitted[f].g * scene.facets[f].area;
    EXPECT_NEAR(all, 0.02 * 0.02 * (40.0 + 39.0 * 40.0 / 2.0), 1e-9);
}

TEST(SeparatedScene, RefusesWhatIsNotDiffuseByNameAndPlace) {
    SceneMaker maker;
    for (const TriangleMesh& face : room(Vec3(-1.0), Vec3(1.0))) maker.add(face, matte(0.5));
    maker.add(Sphere{{0, 0, 0}, 0.3, false}, made_of(Conductor{}));
    maker.parts.origins.resize(7);
    maker.parts.origins[6] = {{"room.xml", 7, 5}, "shape 'ball'", "bsdf 'mirror'"};
    try {
        separate(maker.make(), few);
        FAIL() << "a mirror was accepted";
    } catch (const InputError& e) {
        EXPECT_EQ(std::string(e.what()),
                  "room.xml:7:5: bsdf 'mirror' of shape 'ball' is not diffuse, and R is a number for each patch only where all "
                  "materials are");
    }
}

}  // namespace neumann::separated_scene_test
