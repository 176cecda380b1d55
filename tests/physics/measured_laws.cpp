// How far materials are from reciprocity is measured, and said of those that promise none.
#include "core/scene/measured_laws.h"
#include "tests/physics/scene_maker.h"
#include "tests/physics/seed.h"

#include "core/sampling/independent_sampler.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace neumann::physics {

namespace {

Bsdf tilted(const Bsdf& nested, double angle) {
    return PerturbedNormal([angle](const ShadingPoint&) { return Vec3(std::sin(angle), 0.0, std::cos(angle)); },
                           std::make_shared<const Bsdf>(nested), {false, false, false});
}

// The same quotient with both directions uniform, from eval() alone.
double defect_by_chance(const Bsdf& bsdf) {
    constexpr int count = 1 << 20;
    IndependentSampler sampler(fixed_seed, 0);
    double difference = 0.0, sum = 0.0;
    for (int i = 0; i < count; ++i) {
        sampler.start(static_cast<std::uint64_t>(i));
        const Vec3 a = cosine_hemisphere(sampler.next2()), b = cosine_hemisphere(sampler.next2());
        const double there = eval(bsdf, {}, a, b).g, back = eval(bsdf, {}, b, a).g;
        difference += std::abs(there - back);
        sum += there;
    }
    return difference / sum;
}

}  // namespace

TEST(MeasuredLaws, ReciprocalMaterialsHaveNoDefect) {
    for (const Bsdf& bsdf :
         {Bsdf(Diffuse(Rgb(0.5))), Bsdf(RoughConductor(Ggx(0.2))), Bsdf(Conductor({}, Rgb(1.0))), tilted(Diffuse(Rgb(0.5)), 0.0)})
        EXPECT_NEAR(reciprocity_defect(bsdf, {}, 1024), 0.0, 1e-12);
}

// To 2% of the defect: 16384 pairs, and a million by chance.
TEST(MeasuredLaws, TheDefectOfTiltedNormals) {
    for (const double angle : {0.2, 0.6})
        for (const Bsdf& nested : {Bsdf(Diffuse(Rgb(0.5))), Bsdf(RoughConductor(Ggx(0.4)))}) {
            const Bsdf bsdf = tilted(nested, angle);
            const double expected = defect_by_chance(bsdf);
            EXPECT_GT(expected, 0.05);
            EXPECT_NEAR(reciprocity_defect(bsdf, {}, 1 << 14), expected, 0.02 * expected) << angle;
        }
}

TEST(MeasuredLaws, AreSaidOnceForAllMaterials) {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, glowing(0.5, 1.0));
    EXPECT_EQ(measure_laws(maker.make().geometry, maker.make().materials).materials, 0u);
    EXPECT_TRUE(maker.make().warnings.counts().empty());
    maker.add(Sphere{{0, 0, 0}, 0.3, false}, made_of(tilted(Diffuse(Rgb(0.25)), 0.3)));
    maker.add(Sphere{{0.5, 0, 0}, 0.1, false}, made_of(tilted(Diffuse(Rgb(0.75)), 0.1)));
    maker.parts.origins = {{{"room.xml", 3, 1}, "shape 'sphere'", "bsdf 'diffuse'"},
                           {{"room.xml", 7, 5}, "shape 'sphere'", "bsdf 'bumpmap'"},
                           {{"room.xml", 9, 5}, "shape 'sphere'", "bsdf 'normalmap'"}};
    const Scene scene = maker.make();
    const MeasuredLaws laws = measure_laws(scene.geometry, scene.materials);
    EXPECT_EQ(laws.materials, 2u);
    EXPECT_EQ(laws.largest_albedo, 0.75);
    EXPECT_EQ(laws.brightest, 2u);
    EXPECT_EQ(laws.least_reciprocal, 1u);
    EXPECT_EQ(scene.warnings.counts(),
              (std::map<std::string, std::uint64_t>{
                  {fmt::format("2 materials promise neither energy conservation nor reciprocity; the largest albedo is 0.750 "
                               "(bsdf 'normalmap' of shape 'sphere', room.xml:9:5) and the largest reciprocity defect {:.2g} "
                               "(bsdf 'bumpmap' of shape 'sphere', room.xml:7:5)",
                               laws.reciprocity_defect),
                   1}}));
}

}  // namespace neumann::physics
