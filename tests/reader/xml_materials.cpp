// Materials that only reflect, with their parameters and defaults.
#include "tests/reader/xml_scene_files.h"

namespace neumann::xml_materials_test {

using XmlMaterials = XmlTest;

TEST_F(XmlMaterials, TwoSided) {
    const SceneParts parts = read(
        "<bsdf type='diffuse' id='a'/>"
        "<shape type='cube'><bsdf type='twosided'><ref id='a'/></bsdf></shape>"
        "<shape type='cube'><bsdf type='twosided'><ref id='a'/><bsdf type='diffuse'><float name='reflectance' "
        "value='1'/></bsdf></bsdf></shape>"
        "<shape type='cube'><ref id='a'/></shape>");
    EXPECT_EQ(parts.bsdfs.size(), 2u);
    EXPECT_EQ(parts.sides_of_shape.at(0).front, 0);
    EXPECT_EQ(parts.sides_of_shape.at(0).back, 0);
    EXPECT_EQ(parts.sides_of_shape.at(1).front, 0);
    EXPECT_EQ(parts.sides_of_shape.at(1).back, 1);
    EXPECT_EQ(parts.sides_of_shape.at(2).back, Materials::absorbing);
    EXPECT_EQ(largest_albedo(parts.bsdfs[1]), Rgb(1.0));
}

TEST_F(XmlMaterials, Conductors) {
    const auto reflected = [&](const std::string& inside) {
        const SceneParts parts = read("<shape type='cube'><bsdf type='conductor'>" + inside + "</bsdf></shape>");
        EXPECT_EQ(parts.sides_of_shape.at(0).back, Materials::absorbing);
        EXPECT_EQ(lobe(parts.bsdfs.at(0)).kind, Lobe::Kind::specular);
        return sample(parts.bsdfs.at(0), {}, Vec3(0, 0, 1), Vec2(0.5)).weight;
    };
    const auto at_normal = [](double n, double k) { return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k); };
    EXPECT_EQ(reflected(""), Rgb(1.0));
    EXPECT_EQ(reflected("<string name='material' value='none'/><rgb name='specular_reflectance' value='1, 0.5, 0.25'/>"),
              Rgb(1.0, 0.5, 0.25));
    const Rgb gold = reflected("<rgb name='eta' value='0.143, 0.374, 1.442'/><rgb name='k' value='3.983, 2.385, 1.603'/>");
    EXPECT_NEAR(gold.r, at_normal(0.143, 3.983), 1e-14);
    EXPECT_NEAR(gold.g, at_normal(0.374, 2.385), 1e-14);
    EXPECT_NEAR(gold.b, at_normal(1.442, 1.603), 1e-14);
    EXPECT_NEAR(reflected("<float name='eta' value='2'/><integer name='k' value='3'/>").g, at_normal(2.0, 3.0), 1e-14);
    EXPECT_NEAR(reflected("<float name='eta' value='2'/>").g, at_normal(2.0, 1.0), 1e-14);
    EXPECT_EQ(reflected("<float name='k' value='5'/>"), Rgb(1.0));
    const SceneParts both = read("<shape type='cube'><bsdf type='twosided'><bsdf type='conductor'/></bsdf></shape>");
    EXPECT_EQ(both.sides_of_shape.at(0).front, both.sides_of_shape.at(0).back);
}

TEST_F(XmlMaterials, RoughConductors) {
    const auto material = [&](const std::string& inside) {
        return read("<shape type='cube'><bsdf type='roughconductor'>" + inside + "</bsdf></shape>").bsdfs.at(0);
    };
    EXPECT_TRUE(std::holds_alternative<RoughConductor<Beckmann>>(material("")));
    EXPECT_EQ(lobe(material("")).kind, Lobe::Kind::rough);
    EXPECT_EQ(lobe(material("")).alpha, 0.1);
    EXPECT_EQ(largest_albedo(material("")), Rgb(1.0));
    const Bsdf ggx = material(
        "<string name='distribution' value='ggx'/><float name='alpha_u' value='0.3'/><float name='alpha_v' value='0.3'/>"
        "<boolean name='sample_visible' value='false'/><rgb name='specular_reflectance' value='0.9, 0.8, 0.7'/>"
        "<float name='eta' value='0.2'/><float name='k' value='3'/>");
    ASSERT_TRUE(std::holds_alternative<RoughConductor<Ggx>>(ggx));
    EXPECT_EQ(lobe(ggx).alpha, 0.3);
    EXPECT_EQ(largest_albedo(ggx), Rgb(0.9, 0.8, 0.7));
    // At normal incidence on both sides G = 1 and D = 1/(π α²); Mitsuba's masking is the separable one.
    const Vec3 up(0, 0, 1), slant(0.6, 0, 0.8);
    const double F = (0.64 + 9.0) / (1.44 + 9.0);
    EXPECT_NEAR(eval(ggx, {}, up, up).g, 0.8 * F * inv_pi / 0.09 / 4.0, 1e-13);
    const double G1 = 2.0 / (1.0 + std::sqrt(1.0 + 0.09 * 0.5625));
    const Bsdf perfect = material("<string name='distribution' value='ggx'/><float name='alpha' value='0.3'/>");
    EXPECT_NEAR(eval(perfect, {}, slant, slant).g, G1 * G1 * 0.09 * inv_pi / std::pow(0.36 + 0.09 * 0.64, 2) / (4.0 * 0.64), 1e-13);
}

TEST_F(XmlMaterials, NamedMetals) {
    // As they are often quoted for Mitsuba's RGB modes.
    const auto at_normal = [](double n, double k) { return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k); };
    const Bsdf gold =
        read("<shape type='cube'><bsdf type='conductor'><string name='material' value='Au'/></bsdf></shape>").bsdfs.at(0);
    const Rgb reflected = sample(gold, {}, Vec3(0, 0, 1), Vec2(0.5)).weight;
    EXPECT_NEAR(reflected.r, at_normal(0.143, 3.983), 1e-3);
    EXPECT_NEAR(reflected.g, at_normal(0.375, 2.385), 1e-3);
    EXPECT_NEAR(reflected.b, at_normal(1.442, 1.603), 1e-3);
    // Wavelengths are integrated under D65, so that 2 is 2 in all channels, and 5 is not cut.
    const Bsdf grey = read(
                          "<shape type='cube'><bsdf type='conductor'><spectrum name='eta' value='300:2 900:2'/>"
                          "<spectrum name='k' value='300:5 900:5'/></bsdf></shape>")
                          .bsdfs.at(0);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sample(grey, {}, Vec3(0, 0, 1), Vec2(0.5)).weight[c], at_normal(2.0, 5.0), 2e-4);
}

TEST_F(XmlMaterials, BrushedMetals) {
    const Bsdf brushed = read(
                             "<shape type='cube'><bsdf type='roughconductor'><string name='distribution' value='ggx'/>"
                             "<float name='alpha_u' value='0.1'/><float name='alpha_v' value='0.4'/></bsdf></shape>")
                             .bsdfs.at(0);
    EXPECT_TRUE(needs_coordinates(brushed));
    const Vec3 up(0, 0, 1);
    EXPECT_NEAR(eval(brushed, {}, up, up).g, inv_pi / 0.04 / 4.0, 1e-12);  // D = 1/(π αu αv)
}

TEST_F(XmlMaterials, Plastics) {
    const auto material = [&](const std::string& type, const std::string& inside) {
        const SceneParts parts = read("<shape type='cube'><bsdf type='" + type + "'>" + inside + "</bsdf></shape>");
        EXPECT_EQ(parts.sides_of_shape.at(0).back, Materials::absorbing);
        return parts.bsdfs.at(0);
    };
    const Vec3 up(0, 0, 1);
    // Towards the normal, with Egan and Hilgeman's fit inside.
    const auto diffuse = [](double rho, double in_fit, double eta) {
        const double F = std::pow((eta - 1.0) / (eta + 1.0), 2), n = 1.0 / eta;
        const double fit = -1.4399 * n * n + 0.7099 * n + 0.6681 + 0.0636 * eta;
        return rho * n * n / (1.0 - in_fit * fit) * (1.0 - F) * (1.0 - F) * inv_pi;
    };
    EXPECT_NEAR(eval(material("plastic", ""), {}, up, up).g, diffuse(0.5, 1.0, 1.49 / 1.000277), 1e-13);
    const std::string inside =
        "<rgb name='diffuse_reflectance' value='0.2, 0.6, 0.4'/><string name='int_ior' value='Water'/>"
        "<float name='ext_ior' value='1'/><boolean name='nonlinear' value='true'/>";
    EXPECT_NEAR(eval(material("plastic", inside), {}, up, up).g, diffuse(0.6, 0.6, 1.333), 1e-13);
    EXPECT_EQ(sample(material("plastic", inside), {}, up, Vec2(0.0)).pdf, delta_pdf);
    EXPECT_TRUE(std::holds_alternative<RoughPlastic<Beckmann>>(material("roughplastic", "")));
    EXPECT_EQ(lobe(material("roughplastic", "")).alpha, 0.1);
    const Bsdf black = material("roughplastic",
                                "<string name='distribution' value='ggx'/><float name='alpha' value='0.3'/>"
                                "<float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/>"
                                "<rgb name='diffuse_reflectance' value='0'/><float name='specular_reflectance' value='0.5'/>");
    EXPECT_NEAR(eval(black, {}, up, up).g, 0.5 * 0.04 * inv_pi / 0.09 / 4.0, 1e-13);
}

TEST_F(XmlMaterials, Principled) {
    const auto parts = [&](const std::string& type, const std::string& inside) {
        return read("<shape type='cube'><bsdf type='" + type + "'>" + inside + "</bsdf></shape>");
    };
    const Vec3 up(0, 0, 1);
    // `specular` 0.5 is F = 0.04, and roughness 0.5 is α = 0.25.
    const SceneParts plain = parts("principled", "");
    EXPECT_EQ(plain.sides_of_shape.at(0).back, Materials::absorbing);
    EXPECT_NEAR(eval(plain.bsdfs.at(0), {}, up, up).g, 0.5 * inv_pi + 0.04 * inv_pi / 0.0625 / 4.0, 1e-13);
    const SceneParts glass = parts("principled", "<float name='spec_trans' value='1'/><float name='eta' value='1.5'/>");
    EXPECT_EQ(glass.bsdfs.size(), 2u);
    EXPECT_EQ(glass.sides_of_shape.at(0).front, 0);
    EXPECT_EQ(glass.sides_of_shape.at(0).back, 1);
    const SceneParts sheet = parts("principledthin", "<float name='diff_trans' value='2'/>");
    EXPECT_EQ(sheet.sides_of_shape.at(0).front, sheet.sides_of_shape.at(0).back);
    EXPECT_NEAR(eval(sheet.bsdfs.at(0), {}, up, -up).g, 0.5 * inv_pi, 1e-15);
    EXPECT_EQ(eval(sheet.bsdfs.at(0), {}, up, up).g, 0.0);
}

// Thirty blends, each of two references to the one before. A mixture of a material and itself is that material; of materials that
// differ there is an end to how many.
TEST_F(XmlMaterials, NoDoublingWithoutEnd) {
    const auto blends = [](const std::string& second_around) {
        std::string all = "<bsdf type='diffuse' id='m0'/>\n";
        for (int i = 1; i <= 30; ++i) {
            const std::string ref = "<ref id='m" + std::to_string(i - 1) + "'/>";
            all += "<bsdf type='blendbsdf' id='m" + std::to_string(i) + "'><float name='weight' value='0.5'/>" + ref +
                   (second_around.empty() ? ref : "<bsdf type='" + second_around + "'>" + ref + "</bsdf>") + "</bsdf>\n";
        }
        return all + "<shape type='sphere'><ref id='m30'/></shape>";
    };
    const SceneParts parts = read(blends(""));
    EXPECT_TRUE(std::holds_alternative<Diffuse>(parts.bsdfs.at(static_cast<std::size_t>(parts.sides_of_shape.at(0).front))));
    EXPECT_TRUE(error(blends("mask"))
                    .starts_with("scene.xml:19:1: bsdf 'blendbsdf' is a mixture of 131072 materials, expected at most 65536"))
        << error(blends("mask"));
}

// By their ids, where they have one.
TEST_F(XmlMaterials, ShapesAndMaterialsGoByTheirIds) {
    const SceneParts parts = read(
        "<bsdf type='twosided' id='white'><bsdf type='diffuse'/></bsdf><shape type='cube' id='table'><ref id='white'/></shape>"
        "<shape type='sphere'><bsdf type='dielectric'/></shape>");
    EXPECT_EQ(parts.origins.at(0).shape, "shape 'table'");
    EXPECT_EQ(parts.origins.at(0).bsdf, "bsdf 'white'");
    EXPECT_EQ(parts.origins.at(1).shape, "shape 'sphere'");
    EXPECT_EQ(parts.origins.at(1).bsdf, "bsdf 'dielectric'");
}

}  // namespace neumann::xml_materials_test
