// hide_emitters: what the camera sees of a scene whose lights it sees through.
#include "operators/render/methods/render.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::physics::hidden_lights_test {

constexpr double rho = 0.5, radiance = 3.0;

// A floor below one lamp or two, and a camera above that looks down through them at the floor's middle. `towards_camera`: which
// side of the upper lamp shines.
Scene lamps(bool hide, bool towards_camera) {
    SceneMaker maker;
    maker.add(parallelogram({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}), matte(rho));
    maker.add(parallelogram({-0.5, 0.5, 1}, {1, 0, 0}, {0, -1, 0}), lamp(radiance));
    const TriangleMesh upper = parallelogram({-0.5, -0.5, 2}, {1, 0, 0}, {0, 1, 0});
    if (towards_camera) maker.add(upper, lamp(radiance));
    maker.parts.film = {.width = 2, .height = 2, .crop_width = 2, .crop_height = 2, .filter = BoxFilter()};
    maker.parts.camera.to_world =
        glm::translate(Mat4(1.0), Vec3(0, 0, 3)) * glm::rotate(Mat4(1.0), glm::radians(180.0), Vec3(0, 1, 0));
    maker.parts.camera.fov = glm::radians(0.1);
    maker.parts.hide_emitters = hide;
    return maker.make();
}

// From a point of a plane to a parallel square of side 1 at distance 1 above it, by four times the formula for its corner (a = b =
// ½): F = 1/(2π) [a/√(1+a²) atan(b/√(1+a²)) + b/√(1+b²) atan(a/√(1+b²))].
double form_factor() {
    const double s = std::sqrt(1.25);
    return 4.0 / (2.0 * pi) * 2.0 * (0.5 / s) * std::atan(0.5 / s);
}

Rgb mean(const Image& picture) {
    Rgb sum(0.0);
    for (const Rgb& x : picture.pixels) sum += x / static_cast<double>(picture.pixels.size());
    return sum;
}

void expect_floor(const Estimate& first, const Estimate& second, double tolerance) {
    EXPECT_EQ(mean(first.mean), Rgb(0.0));
    EXPECT_NEAR(mean(second.mean).g, rho * radiance * form_factor(), tolerance * rho * radiance * form_factor());
}

BounceSeries rendered(const Scene& scene, const Method& method, std::uint64_t samples = 4096) {
    return render(scene, method, {.bounces = 1, .samples = samples});
}

// All fields: 512 samples, 2000 patches, 1024 directions.
template <HasFields M>
Method with_fields(M m) {
    m.patches = 2000;
    m.directions = 1024;
    return m;
}

// What is seen is the floor, lit by the lower lamp alone as the upper one shines upwards. Sobol' numbers are 0.3% right with 4096
// samples of a pixel; pointwise finds the lamp by chance.
TEST(HiddenLights, WalkSeesTheFloor) {
    for (const bool towards_camera : {false, true}) {
        const BounceSeries found = rendered(lamps(true, towards_camera), method::Walk());
        expect_floor(found.term(0), found.term(1), 0.003);
    }
}

TEST(HiddenLights, PointwiseSeesTheFloor) {
    const BounceSeries found = rendered(lamps(true, true), method::Pointwise());
    expect_floor(found.term(0), found.term(1), 0.05);
}

TEST(HiddenLights, FieldsSeeTheFloor) {
    for (const Method& method : {with_fields(method::Matrix()), with_fields(method::Gather()), with_fields(method::Patches())}) {
        const BounceSeries found = rendered(lamps(true, true), method, 256);
        expect_floor(found.term(0), found.term(1), std::holds_alternative<method::Patches>(method) ? 0.05 : 0.01);
    }
}

TEST(HiddenLights, NothingIsHiddenWithoutBeingAskedFor) {
    const BounceSeries found = rendered(lamps(false, true), method::Walk(), 128);
    EXPECT_EQ(mean(found.term(0).mean), Rgb(radiance));
    EXPECT_EQ(mean(found.term(1).mean), Rgb(0.0));
    // From behind, a lamp is black and covers the floor.
    EXPECT_EQ(mean(rendered(lamps(false, false), method::Walk(), 128).sum(1).mean), Rgb(0.0));
}

// The surroundings are not seen, but light the floor: with all of the sky above it, ρ L exactly.
TEST(HiddenLights, SurroundingsLightWhatIsSeen) {
    SceneMaker maker;
    maker.add(parallelogram({-4, -4, 0}, {8, 0, 0}, {0, 4, 0}), matte(rho));
    maker.parts.lights.environment = ConstantEnvironment(Rgb(radiance));
    maker.parts.film = {.width = 1, .height = 2, .crop_width = 1, .crop_height = 2, .filter = BoxFilter()};
    maker.parts.camera.to_world =
        glm::translate(Mat4(1.0), Vec3(0, 0, 3)) * glm::rotate(Mat4(1.0), glm::radians(180.0), Vec3(0, 1, 0));
    maker.parts.camera.fov = glm::radians(10.0);
    for (const bool hide : {false, true}) {
        maker.parts.hide_emitters = hide;
        const Scene scene = maker.make();
        const BounceSeries fields = rendered(scene, method::Matrix(), 256), walked = rendered(scene, method::Walk());
        for (const std::size_t i : {0, 1}) {
            for (const PixelEstimate& e : {walked.term(i), fields.term(i)}) {
                // One of the two pixels is beside the floor.
                const Rgb sum = e.mean.pixels[0] + e.mean.pixels[1];
                EXPECT_NEAR(sum.g, i == 1 ? rho * radiance : hide ? 0.0 : radiance, i == 1 ? 0.03 : 0.0) << "bounce " << i;
            }
        }
    }
}

}  // namespace neumann::physics::hidden_lights_test
