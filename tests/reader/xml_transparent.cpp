// Materials that let light through, and mixtures, in scene files.
#include "tests/reader/xml_scene_files.h"

namespace neumann::xml_transparent_test {

class XmlTransparent : public XmlTest {
protected:
    SceneParts cube(const std::string& bsdf) const { return read("<shape type='cube'>" + bsdf + "</shape>"); }
    static const Bsdf& side(const SceneParts& parts, bool front) {
        const Materials::Sides& sides = parts.sides_of_shape.at(0);
        return parts.bsdfs.at(static_cast<std::size_t>(front ? sides.front : sides.back));
    }
    // The direction into which a ray is refracted that arrives at 45°, as the sine of its angle.
    static double sine(const Bsdf& bsdf) {
        return -sample(bsdf, {}, Vec3(std::sqrt(0.5), 0.0, std::sqrt(0.5)), Vec2(1.0 - 1e-9, 0.5)).wi.x;
    }
};

TEST_F(XmlTransparent, Dielectrics) {
    const auto index = [&](const std::string& inside) {
        const SceneParts parts = cube("<bsdf type='dielectric'>" + inside + "</bsdf>");
        EXPECT_TRUE(std::holds_alternative<Dielectric>(side(parts, true)));
        const Vec3 shallow(0.1, 0.0, std::sqrt(0.99));
        const double eta = 0.1 / -sample(side(parts, true), {}, shallow, Vec2(1.0 - 1e-9, 0.5)).wi.x;
        EXPECT_NEAR(0.1 / -sample(side(parts, false), {}, shallow, Vec2(1.0 - 1e-9, 0.5)).wi.x, 1.0 / eta, 1e-12);
        return eta;
    };
    EXPECT_NEAR(index(""), 1.5046 / 1.000277, 1e-12);
    EXPECT_NEAR(index("<string name='int_ior' value='water'/><string name='ext_ior' value='vacuum'/>"), 1.333, 1e-12);
    EXPECT_NEAR(index("<string name='int_ior' value='Diamond'/><integer name='ext_ior' value='1'/>"), 2.419, 1e-12);
    EXPECT_NEAR(index("<float name='int_ior' value='1.2'/><float name='ext_ior' value='1.5'/>"), 0.8, 1e-12);
    const SceneParts coloured = cube(
        "<bsdf type='dielectric'><float name='int_ior' value='2'/><float name='ext_ior' value='1'/>"
        "<rgb name='specular_reflectance' value='0.9, 0.5, 0.1'/><rgb name='specular_transmittance' value='0.8, 0.6, "
        "0.4'/></bsdf>");
    for (const bool front : {true, false}) {
        const double scale = front ? 0.25 : 4.0;
        EXPECT_EQ(sample(side(coloured, front), {}, Vec3(0, 0, 1), Vec2(0.05, 0.5)).weight, Rgb(0.9, 0.5, 0.1));
        EXPECT_EQ(sample(side(coloured, front), {}, Vec3(0, 0, 1), Vec2(0.5, 0.5)).weight, Rgb(0.8, 0.6, 0.4) * scale);
    }
}

TEST_F(XmlTransparent, ThinDielectricsAndNull) {
    const SceneParts pane = cube("<bsdf type='thindielectric'/>");
    for (const bool front : {true, false}) {
        EXPECT_TRUE(std::holds_alternative<ThinDielectric>(side(pane, front)));
        EXPECT_NEAR(sine(side(pane, front)), std::sqrt(0.5), 1e-15);
    }
    const SceneParts nothing = cube("<bsdf type='null'/>");
    for (const bool front : {true, false}) EXPECT_TRUE(std::holds_alternative<Null>(side(nothing, front)));
}

TEST_F(XmlTransparent, RoughDielectrics) {
    const SceneParts frosted = cube("<bsdf type='roughdielectric'/>");
    EXPECT_TRUE(std::holds_alternative<RoughDielectric<Beckmann>>(side(frosted, true)));
    EXPECT_EQ(lobe(side(frosted, true)).alpha, 0.1);
    const double eta = 1.5046 / 1.000277;
    for (const bool front : {true, false}) EXPECT_NEAR(largest_albedo(side(frosted, front)).g, front ? 1.0 : eta * eta, 1e-12);
    const SceneParts ggx = cube(
        "<bsdf type='roughdielectric'><string name='distribution' value='ggx'/><float name='alpha' value='0.3'/>"
        "<boolean name='sample_visible' value='true'/><string name='int_ior' value='water ice'/></bsdf>");
    EXPECT_TRUE(std::holds_alternative<RoughDielectric<Ggx>>(side(ggx, false)));
    EXPECT_EQ(lobe(side(ggx, false)).alpha, 0.3);
}

TEST_F(XmlTransparent, MasksHaveTheSidesOfWhatIsNested) {
    const SceneParts one = cube("<bsdf type='mask'><float name='opacity' value='0.25'/><bsdf type='diffuse'/></bsdf>");
    EXPECT_EQ(largest_albedo(side(one, true)), Rgb(0.25 * 0.5 + 0.75));
    EXPECT_EQ(largest_albedo(side(one, false)), Rgb(0.75));
    const SceneParts two =
        cube("<bsdf type='mask'><bsdf type='twosided'><bsdf type='diffuse'/><bsdf type='conductor'/></bsdf></bsdf>");
    EXPECT_EQ(largest_albedo(side(two, true)), Rgb(0.75));
    EXPECT_EQ(largest_albedo(side(two, false)), Rgb(1.0));
    // The same nested material may stand elsewhere, too.
    const SceneParts shared = read(
        "<bsdf type='diffuse' id='a'/><bsdf type='mask' id='m'><ref id='a'/></bsdf>"
        "<shape type='cube'><ref id='m'/></shape><shape type='sphere'><ref id='a'/></shape><shape type='disk'><ref "
        "id='m'/></shape>");
    EXPECT_EQ(shared.bsdfs.size(), 3u);
    EXPECT_EQ(shared.sides_of_shape.at(0).front, shared.sides_of_shape.at(2).front);
}

TEST_F(XmlTransparent, BlendsMixFromTheFirstToTheSecond) {
    const auto blended = [&](const std::string& weight) {
        const SceneParts parts = cube("<bsdf type='blendbsdf'>" + weight +
                                      "<bsdf type='diffuse'><float name='reflectance' value='0.2'/></bsdf>"
                                      "<bsdf type='diffuse'><float name='reflectance' value='0.6'/></bsdf></bsdf>");
        EXPECT_EQ(parts.sides_of_shape.at(0).back, Materials::absorbing);
        return largest_albedo(side(parts, true)).g;
    };
    EXPECT_NEAR(blended("<float name='weight' value='0.25'/>"), 0.3, 1e-15);
    EXPECT_NEAR(blended("<integer name='weight' value='1'/>"), 0.6, 1e-15);
    EXPECT_NEAR(blended(""), 0.4, 1e-15);
    const SceneParts glass = cube("<bsdf type='blendbsdf'><bsdf type='diffuse'/><bsdf type='dielectric'/></bsdf>");
    EXPECT_TRUE(transmits(side(glass, true)));
    EXPECT_TRUE(transmits(side(glass, false)));
    const SceneParts two =
        cube("<bsdf type='twosided'><bsdf type='blendbsdf'><bsdf type='diffuse'/><bsdf type='conductor'/></bsdf></bsdf>");
    EXPECT_EQ(two.sides_of_shape.at(0).front, two.sides_of_shape.at(0).back);
}

TEST_F(XmlTransparent, Retroreflectors) {
    const SceneParts perfect = cube("<bsdf type='retroreflector'/>");
    EXPECT_TRUE(std::holds_alternative<Retroreflector>(side(perfect, true)));
    EXPECT_EQ(perfect.sides_of_shape.at(0).back, Materials::absorbing);
    EXPECT_EQ(largest_albedo(side(perfect, true)), Rgb(1.0));
    const SceneParts rough =
        cube("<bsdf type='retroreflector'><rgb name='reflectance' value='0.9, 0.8, 0.7'/><float name='alpha' value='0.2'/></bsdf>");
    EXPECT_EQ(lobe(side(rough, true)).alpha, 0.2);
    EXPECT_EQ(largest_albedo(side(rough, true)), Rgb(0.9, 0.8, 0.7));
}

TEST_F(XmlTransparent, ShapesKeepTheirOrigins) {
    const SceneParts parts = read("<bsdf type='null' id='n'/>\n<shape type='cube'><ref id='n'/></shape>\n<shape type='disk'/>");
    ASSERT_EQ(parts.origins.size(), 2u);
    EXPECT_EQ(parts.origins[0].place.line, 3);
    EXPECT_EQ(parts.origins[0].shape, "shape 'cube'");
    EXPECT_EQ(parts.origins[0].bsdf, "bsdf 'n'");
    EXPECT_EQ(parts.origins[1].bsdf, "default bsdf");
}

}  // namespace neumann::xml_transparent_test
