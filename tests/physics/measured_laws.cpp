// How far materials are from reciprocity is measured, and said of those that promise none.
#include "core/scene/measured_laws.h"
#include "tests/physics/scene_maker.h"
#include "tests/physics/seed.h"

#include "core/sampling/sampler.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <tuple>

namespace neumann::physics::measured_laws_test {

Bsdf tilted(const Bsdf& nested, double angle) {
    return PerturbedNormal([angle](const ShadingPoint&) { return Vec3(std::sin(angle), 0.0, std::cos(angle)); },
                           std::make_shared<const Bsdf>(nested), {false, false, false});
}

// The same quotient with both directions uniform, from eval() alone, which is as 1/cosθ where normals are tilted: with directions
// by their cosine the variance would be infinite. The standard error from 64 batches.
std::pair<double, double> defect_by_chance(const Bsdf& bsdf) {
    constexpr int batches = 64, count = 1 << 14;
    Sampler sampler(fixed_seed, 0);
    double mean = 0.0, squares = 0.0;
    for (int batch = 0; batch < batches; ++batch) {
        double difference = 0.0, sum = 0.0;
        for (int i = 0; i < count; ++i) {
            sampler.start(static_cast<std::uint64_t>(batch) * count + static_cast<std::uint64_t>(i));
            const Vec3 a = uniform_hemisphere(sampler.next2()), b = uniform_hemisphere(sampler.next2());
            const double there = eval(bsdf, {}, a, b).g, back = eval(bsdf, {}, b, a).g;
            difference += std::abs(there - back) * a.z * b.z;
            sum += 0.5 * (there + back) * a.z * b.z;
        }
        mean += difference / sum / batches;
        squares += difference / sum * (difference / sum) / batches;
    }
    return {mean, std::sqrt((squares - mean * mean) / (batches - 1))};
}

TEST(MeasuredLaws, ReciprocalMaterialsHaveNoDefect) {
    for (const Bsdf& bsdf :
         {Bsdf(Diffuse(Rgb(0.5))), Bsdf(RoughConductor(Ggx(0.2))), Bsdf(Conductor({}, Rgb(1.0))), tilted(Diffuse(Rgb(0.5)), 0.0)})
        EXPECT_NEAR(reciprocity_defect(bsdf, {}, 1024), 0.0, 1e-12);
}

// To 4.5 standard errors of the one, and half a per cent for the 65,536 pairs of the other: 4 comparisons.
TEST(MeasuredLaws, TheDefectOfTiltedNormals) {
    for (const double angle : {0.2, 0.6})
        for (const Bsdf& nested : {Bsdf(Diffuse(Rgb(0.5))), Bsdf(RoughConductor(Ggx(0.4)))}) {
            const Bsdf bsdf = tilted(nested, angle);
            const auto [expected, error] = defect_by_chance(bsdf);
            EXPECT_GT(expected, 0.05);
            EXPECT_LT(error, 0.01 * expected);
            EXPECT_NEAR(reciprocity_defect(bsdf, {}, 1 << 16), expected, 4.5 * error + 0.005 * expected) << angle;
        }
}

TEST(MeasuredLaws, AreSaidOnceForAllMaterials) {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, glowing(0.5, 1.0));
    EXPECT_EQ(measure_laws(maker.make().geometry, maker.make().materials).materials, 0u);
    EXPECT_TRUE(maker.make().warnings.counts().empty());
    maker.add(Sphere{{0, 0, 0}, 0.3, false}, made_of(tilted(Diffuse(Rgb(0.25)), 0.3)));
    maker.add(Sphere{{0.5, 0, 0}, 0.1, false}, made_of(tilted(Diffuse(Rgb(0.75)), 0.1)));
    for (const auto& [line, column, bsdf] :
         {std::tuple(3, 1, "bsdf 'diffuse'"), std::tuple(7, 5, "bsdf 'bumpmap'"), std::tuple(9, 5, "bsdf 'normalmap'")})
        maker.parts.origins.push_back({{"room.xml", line, column}, "shape 'sphere'", bsdf});
    const Scene scene = maker.make();
    const MeasuredLaws laws = measure_laws(scene.geometry, scene.materials);
    EXPECT_EQ(laws.materials, 2u);
    EXPECT_EQ(laws.largest_albedo, 0.75);
    EXPECT_EQ(laws.brightest, 2u);
    EXPECT_EQ(laws.least_reciprocal, 1u);
    EXPECT_EQ(scene.warnings.counts(),
              (Warnings::Counts{
                  {fmt::format("2 materials promise neither energy conservation nor reciprocity; the largest albedo is 0.750 "
                               "(bsdf 'normalmap' of shape 'sphere', room.xml:9:5) and the largest reciprocity defect {:.2g} "
                               "(bsdf 'bumpmap' of shape 'sphere', room.xml:7:5)",
                               laws.reciprocity_defect),
                   1}}));
}

// Of a surface that gives back more than it receives, which one and how much: as many digits as show it.
TEST(MeasuredLaws, ReflectanceAboveOneIsNamed) {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, glowing(0.5, 1.0));
    maker.add(Sphere{{0, 0, 0}, 0.3, false}, matte(1.0003));
    const auto origin = [](int line, const char* bsdf) {
        return Origin{{"room.xml", line, 1}, "shape 'sphere'", std::string("bsdf '") + bsdf + "'"};
    };
    maker.parts.origins = {origin(3, "diffuse"), origin(7, "diffuse"), origin(9, "normalmap")};
    const std::string head = "reflectance above 1: a surface (bsdf ";
    using Texts = Warnings::Counts;
    EXPECT_EQ(
        maker.make().warnings.counts(),
        (Texts{{head + "'diffuse' of shape 'sphere', room.xml:7:1) gives back up to 1 + 0.0003 times the light that it receives",
                1}}));
    // What a normal map has below it bounds it, and need not be reached.
    maker.add(Sphere{{0.5, 0, 0}, 0.1, false}, made_of(tilted(Diffuse(Rgb(1.25)), 0.1)));
    const Scene scene = maker.make();
    const auto& found = scene.warnings.counts();
    EXPECT_EQ(found.count(head + "'normalmap' of shape 'sphere', room.xml:9:1) may give back up to 1.250 times the light that it "
                                 "receives; 1 other is above 1, too"),
              1u)
        << found.begin()->first;
    EXPECT_EQ(found.size(), 2u);
    EXPECT_NE(found.begin()->first.find("the largest albedo is 1.250 (bsdf 'normalmap' of shape 'sphere', room.xml:9:1)"),
              std::string::npos)
        << found.begin()->first;
}

// Dür's variant of Ward's lobe has no largest albedo.
TEST(MeasuredLaws, ReflectanceWithoutLimitIsNamed) {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, glowing(0.5, 1.0));
    maker.add(Sphere{{0, 0, 0}, 0.3, false}, made_of(Ward(WardLobe(WardLobe::Variant::duer, Beckmann(0.2)), Rgb(0.5), Rgb(0.2))));
    maker.parts.origins = {Origin{{"room.xml", 3, 1}, "shape 'sphere'", "bsdf 'diffuse'"},
                           Origin{{"room.xml", 7, 1}, "shape 'sphere'", "bsdf 'ward'"}};
    EXPECT_EQ(maker.make().warnings.counts(),
              (Warnings::Counts{{"reflectance above 1: a surface (bsdf 'ward' of shape 'sphere', room.xml:7:1) gives "
                                 "back, without limit, more light than it receives at grazing angles",
                                 1}}));
}

}  // namespace neumann::physics::measured_laws_test
