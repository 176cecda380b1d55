// Materials of glTF files, beside the same ones as Mitsuba's plugins.
#include "tests/reader/gltf_scene_files.h"

namespace neumann::gltf_materials_test {

class GltfMaterials : public GltfTest {
protected:
    GltfMaterials() { add_square(); }

    // fs of the material's front in a few directions, above and below, from the middle of its square.
    static std::vector<Rgb> values(const SceneParts& parts, bool front = true) {
        const Materials::Sides sides = parts.sides_of_shape.at(0);
        const int side = front ? sides.front : sides.back;
        if (side == Materials::absorbing) return {};
        std::vector<Rgb> result;
        for (const Vec3 wo : {Vec3(0.1, 0.2, 1.0), Vec3(-0.8, 0.3, 0.4)})
            for (const Vec3 wi : {Vec3(0.3, -0.1, 0.9), Vec3(0.8, -0.35, 0.4), Vec3(-0.1, -0.3, -0.9)})
                result.push_back(eval(parts.bsdfs.at(static_cast<std::size_t>(side)), point_with_coordinates({0.5, 0.5}),
                                      glm::normalize(wo), glm::normalize(wi)));
        return result;
    }
    // The material is the same as this <bsdf>, on both sides.
    void expect_same(const std::string& bsdf) const {
        const SceneParts ours = read_gltf(), theirs = read("<shape type='rectangle'>" + bsdf + "</shape>");
        for (const bool front : {true, false}) {
            const std::vector<Rgb> a = values(ours, front), b = values(theirs, front);
            ASSERT_EQ(a.size(), b.size());
            for (std::size_t i = 0; i < a.size(); ++i)
                EXPECT_LE(glm::distance(a[i], b[i]), 1e-6 * glm::length(b[i])) << bsdf << " direction " << i;
        }
    }
    static std::string two_sided(const std::string& bsdf) { return "<bsdf type='twosided'>" + bsdf + "</bsdf>"; }
    static std::string principled(const std::string& color, const std::string& floats) {
        return "<bsdf type='principled'><rgb name='base_color' value='" + color + "'/>" + floats + "</bsdf>";
    }
    static std::string number(const std::string& name, double value) {
        return "<float name='" + name + "' value='" + std::to_string(value) + "'/>";
    }
};

TEST_F(GltfMaterials, MetallicRoughness) {
    expect_same(two_sided(principled("1, 1, 1", number("metallic", 1) + number("roughness", 1) + number("eta", 1.5))));
    basis() = {{"baseColorFactor", {0.8, 0.4, 0.2, 1.0}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.5}};
    expect_same(two_sided(principled("0.8, 0.4, 0.2", number("metallic", 0.25) + number("roughness", 0.5) + number("eta", 1.5))));
    material()["pbrMetallicRoughness"] = Json::object();
    EXPECT_EQ(
        warnings(read_gltf()),
        "a material of which the file says nothing: white, rough metal, as glTF has it; Blender writes this where the node is not "
        "Principled BSDF or Emission\n");
    basis() = {{"baseColorFactor", {0.8, 0.4, 0.2, 1.0}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.5}};
    material()["occlusionTexture"] = {{"index", add_texture(encode_png_of(1, 3, {0, 0, 0}))}, {"strength", 1}};
    expect_same(two_sided(principled("0.8, 0.4, 0.2", number("metallic", 0.25) + number("roughness", 0.5) + number("eta", 1.5))));
    EXPECT_EQ(warnings(read_gltf()), "");
}

TEST_F(GltfMaterials, DiffuseWhereNothingIsReflectedAtTheBoundary) {
    basis() = {{"baseColorFactor", {0.8, 0.4, 0.2, 1.0}}, {"metallicFactor", 0}};
    extension("KHR_materials_specular")["specularFactor"] = 0;
    expect_same(two_sided("<bsdf type='diffuse'><rgb name='reflectance' value='0.8, 0.4, 0.2'/></bsdf>"));
}

// Half of the reflectance at right angles, ((η − 1)/(η + 1))².
TEST_F(GltfMaterials, Specular) {
    basis() = {{"metallicFactor", 0}, {"roughnessFactor", 0.5}};
    extension("KHR_materials_specular")["specularFactor"] = 0.5;
    extension("KHR_materials_ior")["ior"] = 1.5;
    const double r = 0.2 * std::sqrt(0.5);
    expect_same(two_sided("<bsdf type='principled'><rgb name='base_color' value='1'/>" + number("metallic", 0) +
                          number("roughness", 0.5) + "<float name='eta' value='" + Json((1.0 + r) / (1.0 - r)).dump() +
                          "'/></bsdf>"));
    EXPECT_EQ(
        warnings(read_gltf()),
        "KHR_materials_specular: a specularFactor between 0 and 1, taken as a lower index of refraction: at grazing angles all "
        "light is still reflected\n");
    extension("KHR_materials_specular") = {{"specularColorFactor", {1, 0.5, 0}}};
    EXPECT_EQ(warnings(read_gltf()), "KHR_materials_specular: a coloured reflection, taken as grey of the mean of its channels\n");
}

TEST_F(GltfMaterials, IndexOfRefraction) {
    basis() = {{"metallicFactor", 0}, {"roughnessFactor", 0.5}};
    extension("KHR_materials_ior")["ior"] = 1.8;
    expect_same(two_sided(principled("1, 1, 1", number("metallic", 0) + number("roughness", 0.5) + number("eta", 1.8))));
}

TEST_F(GltfMaterials, Transmission) {
    basis() = {{"baseColorFactor", {0.9, 0.8, 0.7, 1.0}}, {"metallicFactor", 0}, {"roughnessFactor", 0.3}};
    extension("KHR_materials_transmission")["transmissionFactor"] = 0.75;
    extension("KHR_materials_ior")["ior"] = 1.4;
    const std::string floats = "<rgb name='base_color' value='0.9, 0.8, 0.7'/>" + number("roughness", 0.3) + number("eta", 1.4) +
                               number("spec_trans", 0.75);
    expect_same("<bsdf type='principledthin'>" + floats + "</bsdf>");
    EXPECT_EQ(warnings(read_gltf()),
              "KHR_materials_transmission without KHR_materials_volume: a thin sheet of glass, as glTF means it; a thicknessFactor "
              "above 0 makes it the surface of a solid body\n");
    extension("KHR_materials_volume")["thicknessFactor"] = 1;
    expect_same("<bsdf type='principled'>" + floats + "</bsdf>");
    EXPECT_EQ(warnings(read_gltf()), "");
    extension("KHR_materials_volume")["attenuationColor"] = {1, 0, 0};
    extension("KHR_materials_volume")["attenuationDistance"] = 0.1;
    EXPECT_EQ(warnings(read_gltf()), "KHR_materials_volume: what a body absorbs (attenuationColor) left out\n");
}

TEST_F(GltfMaterials, ClearcoatAndSheen) {
    basis() = {{"metallicFactor", 0}, {"roughnessFactor", 0.5}};
    extension("KHR_materials_clearcoat") = {{"clearcoatFactor", 0.5}, {"clearcoatRoughnessFactor", 0.25}};
    extension("KHR_materials_sheen") = {{"sheenColorFactor", {0.1, 0.3, 0.2}}};
    expect_same(
        two_sided(principled("1, 1, 1", number("metallic", 0) + number("roughness", 0.5) + number("eta", 1.5) +
                                            number("clearcoat", 0.5) + number("clearcoat_gloss", 0.75) + number("sheen", 0.3))));
    EXPECT_EQ(warnings(read_gltf()),
              "KHR_materials_clearcoat: taken as the clearcoat of Mitsuba's principled, a quarter as strong and of another shape\n"
              "KHR_materials_sheen: taken as the sheen of Mitsuba's principled, white and of another shape\n");
    const std::size_t texture = add_texture(encode_png_of(1, 3, {255, 0, 0}));
    for (const char* name : {"sheenColorTexture", "sheenRoughnessTexture"})
        extension("KHR_materials_sheen")[name] = {{"index", texture}};
    extension("KHR_materials_clearcoat")["clearcoatNormalTexture"] = {{"index", texture}};
    EXPECT_EQ(warnings(read_gltf()),
              "KHR_materials_clearcoat: clearcoatNormalTexture left out\n"
              "KHR_materials_clearcoat: taken as the clearcoat of Mitsuba's principled, a quarter as strong and of another shape\n"
              "KHR_materials_sheen: sheenColorTexture left out\n"
              "KHR_materials_sheen: sheenRoughnessTexture left out\n"
              "KHR_materials_sheen: taken as the sheen of Mitsuba's principled, white and of another shape\n");
}

TEST_F(GltfMaterials, LeftOutWithAWarning) {
    extension("KHR_materials_iridescence")["iridescenceFactor"] = 1;
    extension("KHR_materials_anisotropy")["anisotropyStrength"] = 1;
    extension("KHR_materials_dispersion")["dispersion"] = 1;
    extension("KHR_materials_unlit") = Json::object();
    extension("EXT_unheard_of") = Json::object();
    material()["novelty"] = 1;
    file["extensionsUsed"] = {"KHR_materials_dispersion", "EXT_unheard_of", "KHR_xmp_json_ld"};
    EXPECT_EQ(warnings(read_gltf()),
              "KHR_materials_anisotropy: reflections that differ by direction left out\n"
              "KHR_materials_dispersion: dispersion left out\n"
              "KHR_materials_iridescence: the thin film left out\n"
              "KHR_materials_unlit: a material that no light reaches, lit like any other\n"
              "the extension EXT_unheard_of is not known and left out\n"
              "the unknown property 'novelty' left out\n");
}

TEST_F(GltfMaterials, Alpha) {
    basis() = {{"baseColorFactor", {0.8, 0.4, 0.2, 0.25}}, {"metallicFactor", 0}, {"roughnessFactor", 0.5}};
    const std::string inner =
        two_sided(principled("0.8, 0.4, 0.2", number("metallic", 0) + number("roughness", 0.5) + number("eta", 1.5)));
    const auto masked = [&](double opacity) { return "<bsdf type='mask'>" + number("opacity", opacity) + inner + "</bsdf>"; };
    expect_same(inner);
    material()["alphaMode"] = "BLEND";
    expect_same(masked(0.25));
    material()["alphaMode"] = "MASK";
    expect_same(masked(0.0));
    material()["alphaCutoff"] = 0.25;
    expect_same(inner);
}

// Radiance as it stands, on the front, and on the back too where that is asked for.
TEST_F(GltfMaterials, Emission) {
    material()["emissiveFactor"] = {1, 0.5, 0.25};
    extension("KHR_materials_emissive_strength")["emissiveStrength"] = 4;
    const auto radiance_of = [](const SceneParts& parts, std::size_t shape) {
        return parts.lights.area.at(static_cast<std::size_t>(parts.lights.of_shape.at(shape))).largest;
    };
    const SceneParts one = read_gltf();
    ASSERT_EQ(one.shapes.size(), 1u);
    EXPECT_EQ(radiance_of(one, 0), Rgb(4.0, 2.0, 1.0));
    material()["doubleSided"] = true;
    const SceneParts two = read_gltf();
    ASSERT_EQ(two.shapes.size(), 2u);
    EXPECT_EQ(radiance_of(two, 1), Rgb(4.0, 2.0, 1.0));
    const TriangleMesh& back = mesh(two, 1);
    const auto& t = back.triangles[0];
    EXPECT_LT(glm::cross(back.vertices[t[1]] - back.vertices[t[0]], back.vertices[t[2]] - back.vertices[t[0]]).z, 0.0);
    for (const Vec3& v : back.vertices) EXPECT_NEAR(v.z, -2e-4 * std::sqrt(0.5), 1e-9);  // behind the front
    material()["emissiveFactor"] = {0, 0, 0};
    EXPECT_EQ(read_gltf().lights.area.size(), 0u);
}

}  // namespace neumann::gltf_materials_test
