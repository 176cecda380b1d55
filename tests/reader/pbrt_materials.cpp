// Materials and textures: pbrt files and Mitsuba files that say the same.
#include "core/image/image_io.h"
#include "tests/reader/pbrt_scene_files.h"

#include <fmt/format.h>

namespace neumann::pbrt_materials_test {

class PbrtMaterials : public PbrtTest {
protected:
    // One sphere with the material.
    void expect_same_material(const std::string& pbrt_material, const std::string& bsdf) const {
        expect_same(pbrt_material + "\nShape \"sphere\"", "<shape type='sphere'>" + bsdf + "</shape>");
    }
    static std::string two_sided(const std::string& type, const std::string& inside) {
        return "<bsdf type='twosided'><bsdf type='" + type + "'>" + inside + "</bsdf></bsdf>";
    }
    static std::string number(const std::string& name, double value) {
        return fmt::format("<float name='{}' value='{}'/>", name, value);
    }
    static std::string ggx(double alpha) { return "<string name='distribution' value='ggx'/>" + number("alpha", alpha); }
    // On meshes pbrt's coordinates are ours; pictures are turned over.
    static std::string bitmap(const std::string& name, const std::string& file, const std::string& inside = "",
                              const std::string& to_uv = "<matrix value='1 0 0 0  0 -1 0 1  0 0 1 0  0 0 0 1'/>") {
        return "<texture type='bitmap' name='" + name + "'><string name='filename' value='" + file + "'/>" + inside +
               "<transform name='to_uv'>" + to_uv + "</transform></texture>";
    }
    void write_pictures() const {
        write("a.ppm", "P3 2 2 255\n255 0 0  0 255 0  0 0 255  128 128 128\n");
        write("b.ppm", "P3 2 2 255\n0 0 0  255 255 255  64 64 64  0 128 255\n");
        write("grey.pgm", "P2 2 2 255\n32 255 64 128\n");
        write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
    }
    void expect_same_on_square(const std::string& pbrt_material, const std::string& bsdf) const {
        expect_same(pbrt_material +
                        "\nShape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 0] \"point2 uv\" [0 0 1 0 1 1 0 1] \"integer "
                        "indices\" [0 1 "
                        "2 0 2 3]",
                    "<shape type='obj'><string name='filename' value='square.obj'/><boolean name='flip_tex_coords' value='false'/>"
                    "<boolean name='face_normals' value='true'/>" +
                        bsdf + "</shape>");
    }
};

TEST_F(PbrtMaterials, Diffuse) {
    expect_same_material("Material \"diffuse\"", two_sided("diffuse", number("reflectance", 0.5)));
    expect_same_material("Material \"diffuse\" \"rgb reflectance\" [0.1 0.2 0.3]",
                         two_sided("diffuse", "<rgb name='reflectance' value='0.1, 0.2, 0.3'/>"));
    expect_same_material("Material \"diffuse\" \"spectrum reflectance\" [400 0.1 600 0.5 700 0.9]",
                         two_sided("diffuse", "<spectrum name='reflectance' value='400:0.1, 600:0.5, 700:0.9'/>"));
    write("a.spd", "# a spectrum\n400 0.1\n600 0.5 700 0.9\n");
    expect_same_material("Material \"diffuse\" \"spectrum reflectance\" \"a.spd\"",
                         two_sided("diffuse", "<spectrum name='reflectance' value='400:0.1, 600:0.5, 700:0.9'/>"));
    expect_same_material(
        "MakeNamedMaterial \"a wall\" \"string type\" \"diffuse\" \"rgb reflectance\" [1 0 0]\nNamedMaterial \"a wall\"",
        two_sided("diffuse", "<rgb name='reflectance' value='1, 0, 0'/>"));
}

TEST_F(PbrtMaterials, Conductors) {
    const std::string gold = "<string name='material' value='Au'/>";
    expect_same_material("Material \"conductor\"", two_sided("conductor", "<string name='material' value='Cu'/>"));
    expect_same_material("Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\"",
                         two_sided("conductor", gold));
    expect_same_material("Material \"conductor\" \"rgb eta\" [0.2 0.9 1.1] \"rgb k\" [3.9 2.4 2.1]",
                         two_sided("conductor", "<rgb name='eta' value='0.2, 0.9, 1.1'/><rgb name='k' value='3.9, 2.4, 2.1'/>"));
    // α = √roughness.
    expect_same_material(
        "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\" \"float roughness\" 0.09",
        two_sided("roughconductor", gold + ggx(0.3)));
    expect_same_material(
        "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\" \"float roughness\" 0.3 \"bool "
        "remaproughness\" false",
        two_sided("roughconductor", gold + ggx(0.3)));
    expect_same_material(
        "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\" \"float uroughness\" 0.09 \"float "
        "vroughness\" 0.25",
        two_sided("roughconductor",
                  gold + "<string name='distribution' value='ggx'/>" + number("alpha_u", 0.3) + number("alpha_v", 0.5)));
    // A metal of η = 1 and k = 2 √r / √(1 − r) reflects r at normal incidence.
    const SceneParts half = read_pbrt("Material \"conductor\" \"rgb reflectance\" [0.5 0.25 0.75]\nShape \"sphere\"");
    expect_near(sample(half.bsdfs.at(0), {}, Vec3(0, 0, 1), Vec2(0.5)).weight, Rgb(0.5, 0.25, 0.75), 1e-12, "reflectance");
    // Brass is yellow.
    const SceneParts brass =
        read_pbrt("Material \"conductor\" \"spectrum eta\" \"metal-CuZn-eta\" \"spectrum k\" \"metal-CuZn-k\"\nShape \"sphere\"");
    const Rgb c = sample(brass.bsdfs.at(0), {}, Vec3(0, 0, 1), Vec2(0.5)).weight;
    EXPECT_GT(c.r, c.g);
    EXPECT_GT(c.g, c.b + 0.2);
    EXPECT_EQ(warning(read_pbrt("Material \"conductor\" \"float roughness\" 0.09")),
              "rough material: its masking is separable (G1 · G1), where pbrt's is height-correlated");
}

TEST_F(PbrtMaterials, Glass) {
    const auto iors = [](double eta) { return number("int_ior", eta) + number("ext_ior", 1.0); };
    expect_same_material("Material \"dielectric\"", "<bsdf type='dielectric'>" + iors(1.5) + "</bsdf>");
    expect_same_material("Material \"dielectric\" \"float eta\" 1.33 \"float roughness\" 0.04",
                         "<bsdf type='roughdielectric'>" + iors(1.33) + ggx(0.2) + "</bsdf>");
    expect_same_material("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"",
                         "<bsdf type='dielectric'>" + iors(1.5168) + "</bsdf>");
    expect_same_material("Material \"dielectric\" \"spectrum eta\" [400 1.6 687.6 1.5]",
                         "<bsdf type='dielectric'>" + iors(1.6 - 0.1 * 187.6 / 287.6) + "</bsdf>");
    expect_same_material("Material \"thindielectric\" \"float eta\" 1.4", "<bsdf type='thindielectric'>" + iors(1.4) + "</bsdf>");
    EXPECT_EQ(warning(read_pbrt("Material \"dielectric\" \"spectrum eta\" \"glass-F11\"")),
              "glass refracts all colours alike, as yellow light (587.6 nm): dispersion is left out");
}

TEST_F(PbrtMaterials, Layers) {
    const std::string coat = number("int_ior", 1.5) + number("ext_ior", 1.0) + "<boolean name='nonlinear' value='true'/>";
    expect_same_material("Material \"coateddiffuse\" \"rgb reflectance\" [0.6 0.3 0.1]",
                         two_sided("plastic", coat + "<rgb name='diffuse_reflectance' value='0.6, 0.3, 0.1'/>"));
    expect_same_material("Material \"coateddiffuse\" \"float roughness\" 0.01",
                         two_sided("roughplastic", coat + number("diffuse_reflectance", 0.5) + ggx(0.1)));
    // The roughness may vary. A square of a checkerboard of pbrt is one of two of Mitsuba's, and Mitsuba swaps those of numbers.
    const SceneParts varies = read_pbrt(
        "Texture \"r\" \"float\" \"checkerboard\" \"float tex1\" 0.01 \"float tex2\" 0.16\n"
        "Material \"coateddiffuse\" \"texture roughness\" \"r\"\nShape \"sphere\"");
    const auto rough = [&](const char* roughness) {
        return read_pbrt(std::string("Material \"coateddiffuse\" \"float roughness\" ") + roughness + "\nShape \"sphere\"");
    };
    const auto front = [](const SceneParts& parts) -> const Bsdf& {
        return parts.bsdfs.at(static_cast<std::size_t>(parts.sides_of_shape.at(0).front));
    };
    const SceneParts first = rough("0.01"), second = rough("0.16");
    for (const auto& [uv, like] : {std::pair(Vec2(0.5, 0.5), &first), {Vec2(1.5, 0.5), &second}}) {
        const Vec3 wo(0.0, 0.6, 0.8), wi(0.1, -0.6, std::sqrt(1.0 - 0.37));
        const double wanted = eval(front(*like), {}, wo, wi).g;
        EXPECT_NEAR(eval(front(varies), point_with_coordinates(uv), wo, wi).g, wanted, 1e-9 * wanted) << uv.x;
    }
    EXPECT_EQ(warning(read_pbrt("Material \"coateddiffuse\"")),
              "coateddiffuse: taken as 'plastic' or 'roughplastic', whose layer absorbs nothing");
    // What a coat of reflectance f leaves of a metal of reflectance m: f + (1 − f)² m / (1 − f m). Here m is that of η and k
    // over 1.5.
    const SceneParts coated =
        read_pbrt("Material \"coatedconductor\" \"rgb conductor.eta\" [1.5 1.5 1.5] \"rgb conductor.k\" [3 3 3]\nShape \"sphere\"");
    const double f = 0.04, m = 4.0 / 8.0, expected = f + (1 - f) * (1 - f) * m / (1 - f * m);
    double mean = 0.0;
    for (int i = 0; i < 100; ++i)
        mean +=
            0.01 * sample(coated.bsdfs.at(coated.sides_of_shape[0].front), {}, Vec3(0, 0, 1), Vec2((i + 0.5) / 100, 0.5)).weight.g;
    EXPECT_NEAR(mean, expected, 1e-12);
}

// r / π on the side of the light and t / π on the other, exactly.
TEST_F(PbrtMaterials, DiffuseTransmission) {
    const SceneParts parts = read_pbrt(
        "Material \"diffusetransmission\" \"rgb reflectance\" [0.4 0.2 0] \"rgb transmittance\" [0.1 0.3 0.2] \"float scale\" "
        "1.2\nShape "
        "\"sphere\"");
    for (const int side : {parts.sides_of_shape.at(0).front, parts.sides_of_shape.at(0).back}) {
        const Bsdf& bsdf = parts.bsdfs.at(static_cast<std::size_t>(side));
        for (const Vec3 wo : {Vec3(0, 0, 1), Vec3(0.6, 0, 0.8)}) {
            expect_near(eval(bsdf, {}, wo, Vec3(0, 0.6, 0.8)), 1.2 * inv_pi * Rgb(0.4, 0.2, 0.0), 1e-12, "reflected");
            expect_near(eval(bsdf, {}, wo, Vec3(0, 0.6, -0.8)), 1.2 * inv_pi * Rgb(0.1, 0.3, 0.2), 1e-12, "let through");
        }
    }
    const SceneParts through = read_pbrt("Material \"diffusetransmission\" \"rgb reflectance\" [0 0 0]\nShape \"sphere\"");
    EXPECT_NEAR(eval(through.bsdfs.at(0), {}, Vec3(0, 0, 1), Vec3(0, 0, -1)).g, 0.25 * inv_pi, 1e-12);
    EXPECT_EQ(eval(through.bsdfs.at(0), {}, Vec3(0, 0, 1), Vec3(0, 0, 1)).g, 0.0);
    // Each is cut off at 1 after the scale, and not their sum.
    const SceneParts more = read_pbrt(
        "Material \"diffusetransmission\" \"rgb reflectance\" [0.6 0.2 0] \"rgb transmittance\" [0.6 0.6 0.3] \"float scale\" 2\n"
        "Shape \"sphere\"");
    const Bsdf& bsdf = more.bsdfs.at(static_cast<std::size_t>(more.sides_of_shape.at(0).front));
    expect_near(eval(bsdf, {}, Vec3(0, 0, 1), Vec3(0, 0, 1)), inv_pi * Rgb(1.0, 0.4, 0.0), 1e-12, "reflected");
    expect_near(eval(bsdf, {}, Vec3(0, 0, 1), Vec3(0, 0, -1)), inv_pi * Rgb(1.0, 1.0, 0.6), 1e-12, "let through");
    EXPECT_EQ(warning(more), "diffusetransmission: reflectance and transmittance add up to more than 1, as pbrt renders it");
}

TEST_F(PbrtMaterials, MixturesAndInterfaces) {
    const std::string red = two_sided("diffuse", "<rgb name='reflectance' value='1, 0, 0'/>"),
                      glass = "<bsdf type='dielectric'>" + number("int_ior", 1.5) + number("ext_ior", 1.0) + "</bsdf>";
    const std::string both =
        "MakeNamedMaterial \"red\" \"string type\" \"diffuse\" \"rgb reflectance\" [1 0 0]\nMakeNamedMaterial \"glass\" \"string "
        "type\" "
        "\"dielectric\"\n";
    // `amount` is the share of the second.
    expect_same_material(both + "Material \"mix\" \"string materials\" [\"red\" \"glass\"] \"float amount\" 0.25",
                         "<bsdf type='blendbsdf'>" + number("weight", 0.25) + red + glass + "</bsdf>");
    EXPECT_TRUE(read_pbrt("Material \"interface\"\nMediumInterface \"\" \"\"\nShape \"sphere\"").shapes.empty());
    EXPECT_EQ(warning(read_pbrt("Material \"interface\"\nAreaLightSource \"diffuse\"\nShape \"sphere\"")),
              "area light on a shape with the material 'interface': left out, as in pbrt");
}

TEST_F(PbrtMaterials, Pictures) {
    write_pictures();
    const auto with = [](const std::string& texture) {
        return "Texture \"t\" \"spectrum\" " + texture + "\nMaterial \"diffuse\" \"texture reflectance\" \"t\"";
    };
    const auto diffuse = [](const std::string& inside) { return two_sided("diffuse", inside); };
    expect_same_on_square(with("\"imagemap\" \"string filename\" \"a.ppm\""), diffuse(bitmap("reflectance", "a.ppm")));
    expect_same_on_square(
        with("\"imagemap\" \"string filename\" \"a.ppm\" \"string filter\" \"point\" \"string wrap\" \"clamp\" \"string encoding\" "
             "\"linear\""),
        diffuse(bitmap("reflectance", "a.ppm",
                       "<string name='filter_type' value='nearest'/><string name='wrap_mode' value='clamp'/><boolean name='raw' "
                       "value='true'/>")));
    // s = 2 u + 0.25, t = 3 v + 0.5, of which 1 − t is the row.
    expect_same_on_square(with("\"imagemap\" \"string filename\" \"a.ppm\" \"float uscale\" 2 \"float vscale\" 3 \"float udelta\" "
                               "0.25 \"float vdelta\" 0.5"),
                          diffuse(bitmap("reflectance", "a.ppm", "", "<scale x='2' y='-3'/><translate x='0.25' y='0.5'/>")));
    // On a sphere pbrt's v runs from the south pole to the north, so the picture stands upright; here v = 1 − v′ and the row is v.
    expect_same(with("\"imagemap\" \"string filename\" \"a.ppm\"") + "\nShape \"sphere\"",
                "<shape type='sphere'>" + diffuse(bitmap("reflectance", "a.ppm", "", "")) + "</shape>");
    // On a disc pbrt's u goes around and v inwards: the row is 1 − (1 − u′) = u′, the column v′.
    expect_same(with("\"imagemap\" \"string filename\" \"a.ppm\"") + "\nShape \"disk\"",
                "<shape type='disk'>" +
                    diffuse(bitmap("reflectance", "a.ppm", "", "<matrix value='0 1 0 0  1 0 0 0  0 0 1 0  0 0 0 1'/>")) +
                    "</shape>");
    // Linear values, times 0.5, and 1 minus that.
    const auto texel = [&](const std::string& parameters) {
        const SceneParts parts =
            read_pbrt(with("\"imagemap\" \"string filename\" \"a.ppm\" \"string filter\" \"point\" " + parameters) +
                      "\nShape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"point2 uv\" [0 0 1 0 0 1]");
        return Rgb(eval(parts.bsdfs.at(0), point_with_coordinates(Vec2(0.75, 0.25)), Vec3(0, 0, 1), Vec3(0, 0, 1)) / inv_pi);
    };
    const double grey = std::pow((128 / 255.0 + 0.055) / 1.055, 2.4);
    expect_near(texel(""), Rgb(grey), 1e-6, "texel");
    expect_near(texel("\"float scale\" 0.5"), Rgb(0.5 * grey), 1e-6, "scaled");
    expect_near(texel("\"float scale\" 0.5 \"bool invert\" true"), Rgb(1.0 - 0.5 * grey), 1e-6, "inverted");
    expect_near(texel("\"float scale\" 10"), Rgb(1.0), 1e-6, "cut off at 1");
    expect_near(texel("\"string encoding\" \"gamma 2\""), Rgb(128 * 128 / 255.0 / 255.0), 1e-6, "gamma");
}

// A texture of an included file is found beside that, wherever it is used.
TEST_F(PbrtMaterials, PicturesBesideIncludedFiles) {
    write("sub folder/a.ppm", "P3 1 1 255\n255 0 0\n");
    write("sub folder/textures.pbrt", "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.ppm\"");
    const SceneParts parts =
        read_pbrt("Include \"sub folder/textures.pbrt\"\nMaterial \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"");
    EXPECT_EQ(largest_albedo(parts.bsdfs.at(0)), Rgb(1.0, 0.0, 0.0));
}

TEST_F(PbrtMaterials, ComputedTextures) {
    write_pictures();
    const auto value = [&](const std::string& textures) {
        const SceneParts parts = read_pbrt(
            "Texture \"a\" \"spectrum\" \"imagemap\" \"string filename\" \"a.ppm\" \"string filter\" \"point\"\n"
            "Texture \"b\" \"spectrum\" \"imagemap\" \"string filename\" \"b.ppm\" \"string filter\" \"point\"\n" +
            textures +
            "\nMaterial \"diffuse\" \"texture reflectance\" \"t\"\nShape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 "
            "1 0] \"point2 uv\" [0 0 1 0 0 1]");
        // The lower left texel: blue in a, 64 in b.
        return Rgb(eval(parts.bsdfs.at(0), point_with_coordinates(Vec2(0.25, 0.25)), Vec3(0, 0, 1), Vec3(0, 0, 1)) / inv_pi);
    };
    const double b = std::pow((64 / 255.0 + 0.055) / 1.055, 2.4);
    expect_near(value("Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [0.1 0.2 0.3]"), Rgb(0.1, 0.2, 0.3), 1e-12,
                "constant");
    expect_near(value("Texture \"t\" \"spectrum\" \"scale\" \"texture tex\" \"a\" \"float scale\" 0.5"), Rgb(0, 0, 0.5), 1e-6,
                "scale");
    expect_near(value("Texture \"t\" \"spectrum\" \"mix\" \"texture tex1\" \"a\" \"texture tex2\" \"b\" \"float amount\" 0.25"),
                0.75 * Rgb(0, 0, 1) + 0.25 * Rgb(b), 1e-6, "mix of pictures");
    expect_near(value("Texture \"t\" \"spectrum\" \"mix\" \"texture tex1\" \"a\" \"rgb tex2\" [1 0 0]"), Rgb(0.5, 0, 0.5), 1e-6,
                "mix");
    // Of the cells [0, 1)² of 2 u and 4 v, the one at (0, 1).
    expect_near(value("Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [1 0 0] \"texture tex2\" \"a\" \"float uscale\" 2 "
                      "\"float vscale\" 6"),
                Rgb(0, 0, 1), 1e-12, "odd cell");
    expect_near(value("Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [1 0 0] \"texture tex2\" \"a\" \"float uscale\" 6 "
                      "\"float vscale\" 6"),
                Rgb(1, 0, 0), 1e-12, "even cell");
}

TEST_F(PbrtMaterials, NumbersThatVary) {
    write_pictures();
    const std::string texture = "Texture \"n\" \"float\" \"imagemap\" \"string filename\" \"grey.pgm\"\n";
    expect_same_on_square(texture + "Material \"dielectric\" \"texture roughness\" \"n\" \"bool remaproughness\" false",
                          "<bsdf type='roughdielectric'>" + number("int_ior", 1.5) + number("ext_ior", 1.0) +
                              "<string name='distribution' value='ggx'/>" + bitmap("alpha", "grey.pgm") + "</bsdf>");
    const std::string red = two_sided("diffuse", number("reflectance", 0.5));
    // Holes: the share that is there is the texture.
    expect_same_on_square(texture + "Attribute \"shape\" \"texture alpha\" \"n\"",
                          "<bsdf type='mask'>" + bitmap("opacity", "grey.pgm") + red + "</bsdf>");
    EXPECT_TRUE(read_pbrt("Shape \"sphere\" \"float alpha\" 0").shapes.empty());
    // A colour as a number is the mean of its channels.
    const SceneParts parts = read_pbrt(
        "Texture \"n\" \"float\" \"imagemap\" \"string filename\" \"a.ppm\" \"string filter\" \"point\"\nShape \"trianglemesh\" "
        "\"point3 P\" "
        "[0 0 0 1 0 0 0 1 0] \"point2 uv\" [0 0 1 0 0 1] \"texture alpha\" \"n\"");
    const Bsdf& mask = parts.bsdfs.at(static_cast<std::size_t>(parts.sides_of_shape.at(0).front));
    EXPECT_NEAR(eval(mask, point_with_coordinates(Vec2(0.25, 0.25)), Vec3(0, 0, 1), Vec3(0, 0, 1)).g, 0.5 * inv_pi / 3.0, 1e-7);
}

TEST_F(PbrtMaterials, NormalsThatVary) {
    write_pictures();
    const auto is_bent = [](const SceneParts& parts) {
        return std::holds_alternative<PerturbedNormal>(parts.bsdfs.at(static_cast<std::size_t>(parts.sides_of_shape.at(0).front)));
    };
    EXPECT_TRUE(is_bent(read_pbrt("Material \"diffuse\" \"string normalmap\" \"a.ppm\"\nShape \"sphere\"")));
    EXPECT_TRUE(
        is_bent(read_pbrt("Texture \"d\" \"float\" \"imagemap\" \"string filename\" \"grey.pgm\"\nMaterial \"diffuse\" \"texture "
                          "displacement\" \"d\"\nShape \"sphere\"")));
}

// A mesh without coordinates has (0, 0), (1, 0), (1, 1) at each triangle's corners in pbrt.
TEST_F(PbrtMaterials, TrianglesWithoutCoordinates) {
    write_pictures();
    const std::string mesh = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 0] \"integer indices\" [0 1 2 0 2 3]";
    EXPECT_TRUE(std::get<TriangleMesh>(read_pbrt(mesh).shapes.at(0)).uv.empty());
    const SceneParts parts = read_pbrt(
        "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.ppm\"\nMaterial \"diffuse\" \"texture reflectance\" "
        "\"t\"\n" +
        mesh);
    const auto& made = std::get<TriangleMesh>(parts.shapes.at(0));
    EXPECT_EQ(made.uv, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 0}, {1, 1}}));
}

}  // namespace neumann::pbrt_materials_test
