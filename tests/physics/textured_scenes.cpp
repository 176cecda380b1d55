// Rendered textures and normal maps against exact integrals. 6 comparisons by z.
#include "core/image/bitmap.h"
#include "core/scene/normal_maps.h"
#include "operators/experiments/known/quadrature.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::physics::textured_scenes_test {

std::shared_ptr<const Bitmap> bitmap(int width, int height, std::vector<float> texels, Bitmap::Filter filter, Bitmap::Wrap wrap) {
    return std::make_shared<const Bitmap>(std::make_shared<const Texels>(Texels{width, height, 1, {}, std::move(texels)}), filter,
                                          wrap, false);
}

// A textured rectangle under a white sky: what it reflects on average is the mean of its texels, with both filters, where the
// picture is repeated.
TEST(TexturedScenes, RectangleUnderAWhiteSky) {
    const std::vector<float> texels{0.1f, 0.8f, 0.3f, 0.9f, 0.5f, 0.0f};
    double mean = 0.0;
    for (const float t : texels) mean += t / 6.0;
    for (const Bitmap::Filter filter : {Bitmap::Filter::nearest, Bitmap::Filter::bilinear}) {
        const auto picture = bitmap(3, 2, texels, filter, Bitmap::Wrap::repeat);
        SceneMaker maker;
        const SurfaceFunction reflectance([picture](const ShadingPoint& p) { return (*picture)(texture_coordinates(p)); },
                                          picture->largest());
        const std::uint32_t floor = maker.add(make_rectangle(Mat4(1.0)), made_of(Diffuse(reflectance)));
        maker.add(Sphere{{0, 0, 0}, 5.0, true}, lamp(1.0));
        const Scene scene = maker.make();
        EXPECT_DOUBLE_EQ(scene.materials.largest_albedo().r, 0.9f);
        const Estimates found = probe(scene, anywhere_on(scene, floor), Technique::bsdf, {.samples = 1024, .bounces = 1});
        expect_matches(found.terms[1], mean, "the mean of the texels");
    }
}

// A lamp [-1, 1]² at height 1 whose radiance grows along u, over a white point below its middle and one beside it:
// K Le = 1/π ∫ L(u) cosθ cosθ' / r² dA, by quadrature.
TEST(TexturedScenes, LampWithATexture) {
    const auto picture = bitmap(2, 1, {0.0f, 4.0f}, Bitmap::Filter::bilinear, Bitmap::Wrap::clamp);
    const auto radiance = [](double x) { return 4.0 * std::min(std::max(x + 0.5, 0.0), 1.0); };
    SceneMaker maker;
    const Mat4 above = {{1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}, {0, 0, 1, 1}};
    maker.add(make_rectangle(above),
              {std::nullopt, AreaLight([picture](const ShadingPoint& p, const Vec3&) { return (*picture)(texture_coordinates(p)); },
                                       picture->largest())});
    maker.add(parallelogram({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}), matte(1.0));
    const Scene scene = maker.make();
    for (const double x : {0.0, 0.8}) {
        const auto strip = [&](double u) {
            return radiance(u) * integrate(-1.0, 1.0, 1e-9, [&](double y) {
                       const double r2 = (u - x) * (u - x) + y * y + 1.0;
                       return inv_pi / (r2 * r2);
                   });
        };
        const double exact =
            integrate(-1.0, -0.5, 1e-9, strip) + integrate(-0.5, 0.5, 1e-9, strip) + integrate(0.5, 1.0, 1e-9, strip);
        const Estimates found = probe(scene, at(scene, {x, 0, 0}, {0, 0, 1}), Technique::mis, {.samples = 1024, .bounces = 1});
        expect_matches(found.terms[1], exact, "light at x = " + std::to_string(x));
    }
}

// A diffuse ρ with normals tilted by τ sees the part (1 + cosτ)/2 of a white sky, weighted by the cosine.
TEST(TexturedScenes, TiltedNormalsUnderAWhiteSky) {
    constexpr double tilt = 0.8, rho = 0.9;
    const PerturbedNormal tilted([](const ShadingPoint&) { return Vec3(std::sin(tilt), 0.0, std::cos(tilt)); },
                                 std::make_shared<const Bsdf>(Diffuse(Rgb(rho))), {true, false, false});
    SceneMaker maker;
    maker.add(make_rectangle(Mat4(1.0)), made_of(tilted));
    maker.add(Sphere{{0, 0, 0}, 5.0, true}, lamp(1.0));
    const Scene scene = maker.make();
    EXPECT_TRUE(has_normal_maps(scene));
    for (const Technique way : {Technique::bsdf, Technique::mis}) {
        const Estimates found = probe(scene, at(scene, {0.1, 0.2, 0}, {0, 0, 1}), way, {.samples = 256, .bounces = 1});
        expect_matches(found.terms[1], rho * 0.5 * (1.0 + std::cos(tilt)), name(way));
    }
}

TEST(TexturedScenes, SmoothMeshesHaveNoNormalMaps) {
    SceneMaker maker;
    TriangleMesh mesh = icosphere(0);
    mesh.normals = mesh.vertices;
    maker.add(mesh, matte(0.5));
    EXPECT_FALSE(has_normal_maps(maker.make()));
}

}  // namespace neumann::physics::textured_scenes_test
