// Each material of Tungsten is the one of Mitsuba that says the same.
#include "tests/reader/gltf_scene_files.h"
#include "tests/reader/tungsten_scene_files.h"

namespace neumann::tungsten_materials_test {

class TungstenMaterials : public TungstenTest {};

const std::string rgb = "<rgb name='reflectance' value='0.1, 0.2, 0.3'/>";

TEST_F(TungstenMaterials, Matte) {
    expect_material({{"type", "lambert"}, {"albedo", {0.1, 0.2, 0.3}}}, two_sided("<bsdf type='diffuse'>" + rgb + "</bsdf>"));
    expect_material({{"type", "lambert"}}, two_sided("<bsdf type='diffuse'><rgb name='reflectance' value='1'/></bsdf>"));
    expect_material({{"type", "null"}}, two_sided("<bsdf type='diffuse'><rgb name='reflectance' value='0'/></bsdf>"));
    expect_material({{"type", "forward"}}, "<bsdf type='null'/>");
    expect_material({{"type", "oren_nayar"}, {"roughness", 0}, {"albedo", {0.1, 0.2, 0.3}}},
                    two_sided("<bsdf type='diffuse'>" + rgb + "</bsdf>"));
    // (1 − ratio) of a lobe and the ratio of Lambert's.
    expect_material({{"type", "phong"}, {"exponent", 20}, {"diffuse_ratio", 0.25}, {"albedo", 0.8}},
                    two_sided("<bsdf type='phong'><float name='exponent' value='20'/><rgb name='diffuse_reflectance' value='0.2'/>"
                              "<rgb name='specular_reflectance' value='0.6'/></bsdf>"));
    // A missing material is white.
    expect_same(scene_of({{"type", "quad"}}),
                "<shape type='rectangle'>" + to_world("<matrix value='0.5 0 0 0 0 0 1 0 0 0.5 0 0 0 0 0 1'/>") +
                    two_sided("<bsdf type='diffuse'><rgb name='reflectance' value='1'/></bsdf>") + "</shape>");
}

TEST_F(TungstenMaterials, Metals) {
    expect_material({{"type", "mirror"}, {"albedo", 0.9}},
                    two_sided("<bsdf type='conductor'><rgb name='specular_reflectance' value='0.9'/></bsdf>"));
    expect_material({{"type", "conductor"}}, two_sided("<bsdf type='conductor'><string name='material' value='Cu'/></bsdf>"));
    expect_material({{"type", "conductor"}, {"material", "Ni"}},
                    two_sided("<bsdf type='conductor'><string name='material' value='Ni_palik'/></bsdf>"));
    expect_material({{"type", "conductor"}, {"eta", {0.2, 0.9, 1.1}}, {"k", 3}, {"albedo", 0.5}},
                    two_sided("<bsdf type='conductor'><rgb name='eta' value='0.2, 0.9, 1.1'/><rgb name='k' value='3'/><rgb "
                              "name='specular_reflectance' value='0.5'/></bsdf>"));
    expect_material({{"type", "rough_conductor"}, {"material", "Al"}, {"distribution", "beckmann"}, {"roughness", 0.3}},
                    two_sided("<bsdf type='roughconductor'><string name='material' value='Al'/><string name='distribution' "
                              "value='beckmann'/><float name='alpha' value='0.3'/></bsdf>"));
    expect_material({{"type", "rough_conductor"}, {"roughness", 0}},
                    two_sided("<bsdf type='roughconductor'><string name='material' value='Cu'/><string name='distribution' "
                              "value='ggx'/><float name='alpha' value='0.001'/></bsdf>"));
    const SceneParts phong = read_tungsten(scene_with({{"type", "rough_conductor"}, {"distribution", "phong"}}));
    EXPECT_EQ(warnings(phong), "the distribution 'phong' of microfacets: 'beckmann' of the same roughness is taken\n");
}

TEST_F(TungstenMaterials, Glass) {
    const std::string vacuum = "<float name='ext_ior' value='1'/>";
    const std::string tint = "<rgb name='specular_reflectance' value='0.9'/><rgb name='specular_transmittance' value='0.9'/>";
    expect_material({{"type", "dielectric"}, {"ior", 1.7}, {"albedo", 0.9}},
                    "<bsdf type='dielectric'><float name='int_ior' value='1.7'/>" + vacuum + tint + "</bsdf>");
    expect_material({{"type", "rough_dielectric"}, {"roughness", 0.2}, {"albedo", 0.9}},
                    "<bsdf type='roughdielectric'><float name='int_ior' value='1.5'/>" + vacuum + tint +
                        "<string name='distribution' value='ggx'/><float name='alpha' value='0.2'/></bsdf>");
    // What it does not let through is lost.
    expect_material({{"type", "dielectric"}, {"enable_refraction", false}},
                    two_sided("<bsdf type='plastic'><float name='int_ior' value='1.5'/>" + vacuum +
                              "<rgb name='diffuse_reflectance' value='0'/></bsdf>"));
    expect_material({{"type", "thinsheet"}},
                    "<bsdf type='thindielectric'><float name='int_ior' value='1.5'/>" + vacuum + "</bsdf>");
    EXPECT_EQ(warnings(read_tungsten(scene_with({{"type", "thinsheet"}}))),
              "thinsheet: light between its sides is taken as unpolarised, as in Mitsuba\n");
    expect_material({{"type", "diffuse_transmission"}, {"albedo", 0.6}},
                    "<bsdf type='blendbsdf'><float name='weight' value='0.5'/>" +
                        two_sided("<bsdf type='diffuse'><rgb name='reflectance' value='0.6'/></bsdf>") +
                        "<bsdf type='principledthin'><rgb name='base_color' value='0.6'/><float name='diff_trans' "
                        "value='2'/></bsdf></bsdf>");
}

TEST_F(TungstenMaterials, Layers) {
    const std::string vacuum = "<float name='ext_ior' value='1'/>";
    expect_material(
        {{"type", "plastic"}, {"ior", 1.6}, {"albedo", {0.1, 0.2, 0.3}}},
        two_sided("<bsdf type='plastic'><float name='int_ior' value='1.6'/>" + vacuum +
                  "<rgb name='diffuse_reflectance' value='0.1, 0.2, 0.3'/><boolean name='nonlinear' value='true'/></bsdf>"));
    const Json rough = {{"type", "rough_plastic"}, {"roughness", 0.3}, {"albedo", 0.5}};
    expect_material(rough, two_sided("<bsdf type='roughplastic'><float name='int_ior' value='1.5'/>" + vacuum +
                                     "<rgb name='diffuse_reflectance' value='0.5'/><boolean name='nonlinear' value='true'/><string "
                                     "name='distribution' value='ggx'/><float name='alpha' value='0.3'/></bsdf>"));
    EXPECT_EQ(warnings(read_tungsten(scene_with(rough))),
              "rough_plastic: light enters it through a rough surface, in Tungsten through a smooth one\n");
    const std::string metal = two_sided(
        "<bsdf type='roughconductor'><string name='material' value='Cu'/><string name='distribution' value='ggx'/><float "
        "name='alpha' value='0.1'/></bsdf>");
    const std::string coat = "<bsdf type='coating'><float name='int_ior' value='1.7'/>" + vacuum +
                             "<float name='thickness' value='5'/><rgb name='sigma_a' value='0.1, 0.2, 0.5'/>" + metal + "</bsdf>";
    expect_material({{"type", "smooth_coat"}, {"ior", 1.7}, {"thickness", 5}, {"sigma_a", {0.1, 0.2, 0.5}}}, coat);
    expect_material({{"type", "smooth_coat"},
                     {"ior", 1.7},
                     {"thickness", 5},
                     {"sigma_a", {0.1, 0.2, 0.5}},
                     {"substrate", {{"type", "rough_conductor"}}}},
                    coat);
}

// The ratio is that of the first.
TEST_F(TungstenMaterials, Mixtures) {
    const Json black = {{"type", "null"}}, white = {{"type", "lambert"}};
    const std::string of_black = "<bsdf type='diffuse'><rgb name='reflectance' value='0'/></bsdf>",
                      of_white = "<bsdf type='diffuse'><rgb name='reflectance' value='1'/></bsdf>";
    expect_material(
        {{"type", "mixed"}, {"bsdf0", white}, {"bsdf1", black}, {"ratio", 0.3}},
        "<bsdf type='blendbsdf'><float name='weight' value='0.3'/>" + two_sided(of_black) + two_sided(of_white) + "</bsdf>");
    expect_material({{"type", "transparency"}, {"alpha", 0.3}},
                    "<bsdf type='mask'><float name='opacity' value='0.3'/>" + two_sided(of_white) + "</bsdf>");
    // Beside glass, what reflects has one side.
    expect_material({{"type", "mixed"}, {"bsdf0", white}, {"bsdf1", {{"type", "dielectric"}}}},
                    "<bsdf type='blendbsdf'><float name='weight' value='0.5'/><bsdf type='dielectric'><float name='int_ior' "
                    "value='1.5'/><float name='ext_ior' value='1'/></bsdf>" +
                        of_white + "</bsdf>");
}

// enable_two_sided_shading is on unless the integrator says otherwise; mirrors have two sides in any case.
TEST_F(TungstenMaterials, Sides) {
    Json file = scene_with({{"type", "lambert"}});
    const auto back = [&] { return read_tungsten(file).sides_of_shape.at(0).back; };
    EXPECT_NE(back(), Materials::absorbing);
    file["integrator"] = {{"type", "path_tracer"}, {"enable_two_sided_shading", false}};
    EXPECT_EQ(back(), Materials::absorbing);
    file["primitives"][0]["bsdf"]["type"] = "mirror";
    EXPECT_NE(back(), Materials::absorbing);
}

TEST_F(TungstenMaterials, ByName) {
    Json file = scene_with("second");
    file["bsdfs"] = {{{"name", "first"}, {"type", "lambert"}, {"albedo", 0.25}},
                     {{"name", "second"}, {"type", "mixed"}, {"bsdf0", "first"}, {"bsdf1", "third"}},
                     {{"name", "third"}, {"type", "lambert"}, {"albedo", 0.25}},
                     {{"name", "a.b $c"}, {"type", "null"}}};
    const std::string quarter = two_sided("<bsdf type='diffuse'><rgb name='reflectance' value='0.25'/></bsdf>");
    expect_same(file, "<shape type='rectangle'>" + to_world("<matrix value='0.5 0 0 0 0 0 1 0 0 0.5 0 0 0 0 0 1'/>") +
                          "<bsdf type='blendbsdf'><float name='weight' value='0.5'/>" + quarter + quarter + "</bsdf></shape>");
    file["primitives"][0]["bsdf"] = "a.b $c";
    EXPECT_EQ(read_tungsten(file).shapes.size(), 1u);
}

TEST_F(TungstenMaterials, Textures) {
    write("a b/ä.png", encode_png_of(2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}));
    const auto bitmap = [](const std::string& more) {
        return two_sided(
            "<bsdf type='diffuse'><texture type='bitmap' name='reflectance'><string name='filename' value='a b/ä.png'/>" + more +
            "<transform name='to_uv'><scale y='-1'/><translate y='1'/></transform></texture></bsdf>");
    };
    expect_material({{"type", "lambert"}, {"albedo", "a b\\ä.png"}}, bitmap(""));
    expect_material({{"type", "lambert"}, {"albedo", {{"type", "bitmap"}, {"file", "a b/ä.png"}}}}, bitmap(""));
    expect_material(
        {{"type", "lambert"},
         {"albedo",
          {{"type", "bitmap"}, {"file", "a b/ä.png"}, {"gamma_correct", false}, {"interpolate", false}, {"clamp", true}}}},
        bitmap("<boolean name='raw' value='true'/><string name='filter_type' value='nearest'/><string name='wrap_mode' "
               "value='clamp'/>"));
    expect_material({{"type", "lambert"}, {"albedo", {{"type", "constant"}, {"value", {0.1, 0.2, 0.3}}}}},
                    two_sided("<bsdf type='diffuse'>" + rgb + "</bsdf>"));
    // The first square is off, the one beside it on.
    const std::string squares = "<transform name='to_uv'><scale x='2' y='1.5'/></transform>";
    expect_material(
        {{"type", "lambert"},
         {"albedo", {{"type", "checker"}, {"on_color", {0.1, 0.2, 0.3}}, {"off_color", 0.7}, {"res_u", 4}, {"res_v", 3}}}},
        two_sided("<bsdf type='diffuse'><texture type='checkerboard' name='reflectance'><rgb name='color0' value='0.7'/><rgb "
                  "name='color1' value='0.1, 0.2, 0.3'/>" +
                  squares + "</texture></bsdf>"));
}

// As numbers: the mean of the channels, as the file has them, and alpha.
TEST_F(TungstenMaterials, NumbersInPictures) {
    const auto reflected = [&](const Json& bsdf) {
        const SceneParts parts = read_tungsten(scene_with(bsdf));
        EXPECT_EQ(warnings(parts), "");
        const Bsdf& front = parts.bsdfs.at(static_cast<std::size_t>(parts.sides_of_shape.at(0).front));
        return eval(front, point_with_coordinates({0.5, 0.5}), {0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}).r * 3.14159265358979;
    };
    write("mean.png", encode_png_of(1, 3, {0, 51, 102}));
    write("alpha.png", encode_png_of(1, 4, {255, 255, 255, 102}));
    const Json black = {{"type", "null"}}, white = {{"type", "lambert"}};
    EXPECT_NEAR(reflected({{"type", "mixed"}, {"bsdf0", white}, {"bsdf1", black}, {"ratio", "mean.png"}}), 0.2, 1e-6);
    EXPECT_NEAR(reflected({{"type", "transparency"}, {"base", white}, {"alpha", "alpha.png"}}), 0.4, 1e-6);
    const Json squares = {{"type", "checker"}, {"on_color", 0.9}, {"off_color", 0.3}, {"res_u", 1}, {"res_v", 1}};
    EXPECT_NEAR(reflected({{"type", "mixed"}, {"bsdf0", white}, {"bsdf1", black}, {"ratio", squares}}), 0.3, 1e-6);
    EXPECT_EQ(warnings(read_tungsten(scene_with({{"type", "transparency"}, {"alpha", "mean.png"}}))),
              "an opacity that is a picture without alpha: opaque, as in Tungsten\n");
}

}  // namespace neumann::tungsten_materials_test
