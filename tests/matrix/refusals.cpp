// Materials that patches do not hold are refused by name and place.
#include "operators/fields/matrix/sides.h"
#include "tests/physics/scene_maker.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

namespace neumann::refusals_test {

using namespace physics;

std::string refusal(const Surface& surface, std::vector<Origin> origins = {}) {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, matte(0.5));
    maker.add(Sphere{{0, 0, 0}, 0.3, false}, surface);
    maker.parts.origins = std::move(origins);
    try {
        side_directions(maker.make());
    } catch (const InputError& e) {
        return e.what();
    }
    return "none";
}

const SurfaceFunction varying([](const ShadingPoint& p) { return Rgb(texture_coordinates(p).x); }, Rgb(1.0));

TEST(PatchRefusals, OfMixedGlass) {
    std::vector<Origin> origins(2);
    origins[1].place = {"room.xml", 7, 5};
    origins[1].shape = "shape 'sphere'";
    origins[1].bsdf = "bsdf 'mask'";
    const auto glass = std::make_shared<const Bsdf>(Dielectric(1.5)), matt = std::make_shared<const Bsdf>(Diffuse(Rgb(0.5)));
    EXPECT_EQ(
        refusal(made_of(Mask(glass, Rgb(0.5))), origins),
        "room.xml:7:5: bsdf 'mask' of shape 'sphere' lets light through otherwise than glass does, which patches do not hold, "
        "and walk does");
    EXPECT_EQ(refusal(made_of(Blend(matt, glass, Rgb(0.5)))),
              "the material of shape 1 lets light through otherwise than glass does, which patches do not hold, "
              "and walk does");
    EXPECT_EQ(refusal(boundary(*glass, Dielectric(1.0 / 1.5))), "none");
    EXPECT_EQ(refusal(made_of(Blend(matt, std::make_shared<const Bsdf>(ThinDielectric(1.5)), Rgb(0.5)))), "none");
}

TEST(PatchRefusals, OfTexturesThatAreNoFactor) {
    const auto matt = std::make_shared<const Bsdf>(Diffuse(Rgb(0.5))),
               metal = std::make_shared<const Bsdf>(RoughConductor(Ggx(0.3)));
    EXPECT_EQ(refusal(made_of(Blend(matt, metal, varying))),
              "the material of shape 1 varies by more than a factor of its reflectance, which patches do not hold, "
              "and walk does");
    EXPECT_EQ(refusal(made_of(Diffuse(varying))), "none");
    EXPECT_EQ(refusal(made_of(RoughConductor(Ggx(0.3), {}, varying))), "none");
    EXPECT_EQ(refusal(made_of(Blend(matt, matt, varying))), "none");
    EXPECT_EQ(refusal(made_of(Blend(matt, metal, Rgb(0.5)))), "none");
    EXPECT_EQ(refusal(made_of(Retroreflector(varying))), "none");
}

TEST(PatchRefusals, OfAnisotropy) {
    const auto brushed = std::make_shared<const Bsdf>(RoughConductor(Ggx(Vec2(0.1, 0.3))));
    EXPECT_EQ(refusal(made_of(*brushed)), "the material of shape 1 is anisotropic, which patches do not hold, and walk does");
    EXPECT_EQ(refusal(made_of(Blend(std::make_shared<const Bsdf>(Diffuse(Rgb(0.5))), brushed, Rgb(0.5)))),
              "the material of shape 1 is anisotropic, which patches do not hold, and walk does");
}

}  // namespace neumann::refusals_test
