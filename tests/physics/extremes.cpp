// Odd scenes with plain answers.
#include "core/sampling/warp.h"
#include "operators/render/methods/render.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

namespace neumann::physics::extremes_test {

constexpr Technique all_techniques[] = {Technique::mis, Technique::bsdf, Technique::light, Technique::pointwise,
                                        Technique::surfaces};

// A surface seen from behind is black: it neither shines nor reflects, and it hides what is beyond.
TEST(Extremes, FromBehindASurfaceIsBlack) {
    SceneMaker maker;
    const std::uint32_t glowing_floor = maker.add(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), glowing(0.8, 1.0));
    maker.add(parallelogram({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}), glowing(0.5, 3.0));
    const Scene scene = maker.make();
    const SurfacePoint p = surface_point(scene, {0.2, 0.1, 0}, {0, 0, -1});
    ASSERT_EQ(p.shape, glowing_floor);
    const Vec3 down(0, 0.6, -0.8);
    for (const Technique technique : all_techniques) {
        SCOPED_TRACE(name(technique));
        const Estimates found = probe(scene,
                                      [=](Random&) {
                                          return Start{p, down};
                                      },
                                      technique, {.samples = 16, .bounces = 3, .rest_probability = 1.0});
        for (const Statistic& term : found.terms) expect_matches(term, 0.0, "light from a back side");
        expect_matches(found.rest, 0.0, "rest");
    }
    // The lower floor sees the upper one's back only: what it reflects is nothing.
    for (const Technique technique : all_techniques) {
        SCOPED_TRACE(name(technique));
        const Estimates found = probe(scene, at(scene, {0, 0, -2}, {0, 0, 1}), technique, {.samples = 256, .bounces = 3});
        expect_matches(found, std::vector{3.0, 0.0, 0.0, 0.0});
    }
}

// Only a light without area, only a black room, no surfaces at all: zeros, with finite statistics.
TEST(Extremes, WithoutLightOrSurfacesAllIsZero) {
    for (int kind = 0; kind < 3; ++kind) {
        SceneMaker maker;
        maker.parts.camera.fov = 1.0;
        maker.parts.film = {4, 4, 0, 0, 4, 4};
        if (kind > 0) maker.add(make_cube(Mat4(1.0), true), matte(0.9));
        if (kind > 1) maker.add(triangle({0, 0, 0.5}, {0, 0.1, 0.5}, {0, 0.2, 0.5}), lamp(1.0));
        const Scene scene = maker.make();
        EXPECT_FALSE(scene.warnings.counts().empty());
        for (const DirectLight direct : {DirectLight::mis, DirectLight::light, DirectLight::bsdf}) {
            method::Walk walk;
            walk.direct = {direct};
            const BounceSeries pictures = render(scene, walk, {.bounces = 4, .samples = 32});
            for (std::size_t q = 0; q <= 4; ++q)
                for (const PixelEstimate& e : {pictures.term(q), pictures.sum(q), *pictures.rest})
                    for (std::size_t i = 0; i < e.mean.pixels.size(); ++i) {
                        EXPECT_TRUE(is_black(e.mean.pixels[i]));
                        EXPECT_TRUE(is_black(e.standard_error.pixels[i]));
                    }
            EXPECT_EQ(std::get<PathRecord>(pictures.record).health->non_finite(), 0u);
        }
    }
}

}  // namespace neumann::physics::extremes_test
