// Textures in scene files.
#include "core/image/image_io.h"
#include "tests/reader/xml_scene_files.h"

#include <numbers>

namespace neumann::xml_textures_test {

class XmlTextures : public XmlTest {
protected:
    XmlTextures() {
        write_four(188);
        Image image(2, 1);
        image.at(0, 0) = Rgb(0.25, 0.5, 2.0);
        image.at(1, 0) = Rgb(1.0, 1.5, 0.0);
        write("two.exr", encode_exr(Estimate{image, {}}));
        image.at(0, 0).g = -0.5;
        write("negative.exr", encode_exr(Estimate{image, {}}));
        image.at(0, 0).g = NAN;
        write("nan.exr", encode_exr(Estimate{image, {}}));
    }
    // 2×2: black and white over red and grey.
    void write_four(std::uint8_t grey) const {
        DisplayImage image(2, 2, grey);
        image.bytes = {0, 0, 0, 255, 255, 255, 255, 0, 0, grey, grey, grey};
        write("four.png", encode_png(image));
    }
    static std::string bitmap(const std::string& file, const std::string& inside = "") {
        return "<texture name='reflectance' type='bitmap'><string name='filename' value='" + file + "'/>" + inside + "</texture>";
    }
    SceneParts rectangle(const std::string& texture) const {
        return read("<shape type='rectangle'><bsdf type='diffuse'>" + texture + "</bsdf></shape>");
    }
    static Rgb at(const SceneParts& parts, double u, double v) {
        return reflectance(parts.bsdfs.at(0), point_with_coordinates({u, v}));
    }
    // A square of two triangles, with colours of vertices and faces.
    void write_colours() const {
        write("colours.ply",
              "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
              "property float r\nproperty float g\nproperty float b\nelement face 2\nproperty list uchar int vertex_indices\n"
              "property float r\nproperty float g\nproperty float b\nend_header\n"
              "0 0 0 0 0 0.5\n1 0 0 1 0 0\n1 1 0 1 0.75 0\n0 1 0 0 1 0\n3 0 1 2 0.5 0 0\n3 0 2 3 0 0.25 0\n");
    }
    static std::string coloured(const std::string& attribute, const std::string& inside = "") {
        return "<shape type='ply'><string name='filename' value='colours.ply'/><bsdf type='diffuse'>\n"
               "<texture name='reflectance' type='mesh_attribute'><string name='name' value='" +
               attribute + "'/>" + inside + "</texture></bsdf></shape>";
    }
    std::string bitmap_error(const std::string& file) const { return error("<bsdf type='diffuse'>\n" + bitmap(file) + "</bsdf>"); }
};

// Row 0 of the picture is at v = 0, and its first pixel at u = 0, as in Mitsuba.
TEST_F(XmlTextures, Bitmaps) {
    const SceneParts parts = rectangle(bitmap("four.png"));
    EXPECT_EQ(at(parts, 0.25, 0.25), Rgb(0.0));
    EXPECT_EQ(at(parts, 0.75, 0.25), Rgb(1.0));
    EXPECT_EQ(at(parts, 0.25, 0.75), Rgb(1.0, 0.0, 0.0));
    EXPECT_NEAR(at(parts, 0.75, 0.75).g, std::pow((188.0 / 255.0 + 0.055) / 1.055, 2.4), 1e-15);
    EXPECT_EQ(at(parts, 0.5, 0.25), Rgb(0.5));
    EXPECT_EQ(at(parts, 1.0, 0.25), Rgb(0.5));
    EXPECT_EQ(largest_albedo(parts.bsdfs[0]), Rgb(1.0));
    EXPECT_FALSE(is_constant(parts.bsdfs[0]));
    EXPECT_TRUE(needs_coordinates(parts.bsdfs[0]));
    EXPECT_DOUBLE_EQ(at(rectangle(bitmap("four.png", "<boolean name='raw' value='true'/>")), 0.75, 0.75).g, 188.0 / 255.0);
    EXPECT_EQ(at(rectangle(bitmap("four.png", "<string name='filter_type' value='nearest'/>")), 0.49, 0.01), Rgb(0.0));
    EXPECT_EQ(at(rectangle(bitmap("four.png", "<string name='wrap_mode' value='clamp'/>")), 9.0, 0.25), Rgb(1.0));
    EXPECT_EQ(at(rectangle(bitmap("four.png", "<string name='wrap_mode' value='mirror'/>")), 1.25, 0.25), Rgb(1.0));
    const SceneParts moved =
        rectangle(bitmap("four.png", "<transform name='to_uv'><scale x='2' y='-1'/><translate x='0.5' y='1'/></transform>"));
    EXPECT_EQ(at(moved, 0.125, 0.75), Rgb(1.0));
    EXPECT_EQ(at(moved, 0.375, 0.25), Rgb(1.0, 0.0, 0.0));
}

TEST_F(XmlTextures, FloatsAreLinear) {
    const SceneParts parts = rectangle(bitmap("two.exr"));
    EXPECT_EQ(at(parts, 0.25, 0.5), Rgb(0.25, 0.5, 2.0));
    EXPECT_EQ(at(parts, 0.5, 0.1), Rgb(0.625, 1.0, 1.0));
    EXPECT_EQ(largest_albedo(parts.bsdfs[0]), Rgb(1.0, 1.5, 2.0));
}

TEST_F(XmlTextures, ByReference) {
    const SceneParts parts = read(
        "<texture type='bitmap' id='t'><string name='filename' value='two.exr'/></texture>"
        "<shape type='rectangle'><bsdf type='diffuse'><ref name='reflectance' id='t'/></bsdf></shape>"
        "<shape type='rectangle'><bsdf type='conductor'><ref name='specular_reflectance' id='t'/></bsdf></shape>");
    EXPECT_EQ(at(parts, 0.25, 0.5), Rgb(0.25, 0.5, 2.0));
    EXPECT_EQ(largest_albedo(parts.bsdfs[1]), Rgb(1.0, 1.5, 2.0));
}

TEST_F(XmlTextures, Checkerboards) {
    const SceneParts plain = rectangle("<texture name='reflectance' type='checkerboard'/>");
    EXPECT_EQ(at(plain, 0.2, 0.3), Rgb(0.4));
    EXPECT_EQ(at(plain, 0.7, 0.3), Rgb(0.2));
    EXPECT_EQ(at(plain, 0.7, 0.8), Rgb(0.4));
    EXPECT_EQ(at(plain, -0.3, -0.2), Rgb(0.4));
    EXPECT_EQ(largest_albedo(plain.bsdfs[0]), Rgb(0.4));
    const SceneParts nested = rectangle(
        "<texture name='reflectance' type='checkerboard'><texture name='color0' type='bitmap'>"
        "<string name='filename' value='two.exr'/></texture><rgb name='color1' value='0.1, 0.9, 0.3'/>"
        "<transform name='to_uv'><scale x='4' y='3'/></transform></texture>");
    EXPECT_EQ(largest_albedo(nested.bsdfs[0]), Rgb(1.0, 1.5, 2.0));
    // Half of the area has each colour: 8 squares along u, 6 along v, counted at the middle of each.
    int second = 0;
    for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 6; ++j) second += at(nested, (i + 0.5) / 8.0, (j + 0.5) / 6.0) == Rgb(0.1, 0.9, 0.3);
    EXPECT_EQ(second, 24);
    // The nested picture is not scaled: ⅝ of the way from its last pixel to its first.
    EXPECT_EQ(at(nested, 0.0625, 1.0 / 12.0), Rgb(0.53125, 0.875, 1.25));
}

// Mitsuba's checkerboard has its squares the other way round where it is asked for a number: its eval_1 gives color0 where the
// parts of u and v are on different sides of ½, and its eval where they are on the same side. What is nested in it is asked for a
// number, too.
TEST_F(XmlTextures, CheckerboardsOfNumbers) {
    const std::string board =
        "type='checkerboard'><float name='color0' value='0.25'/><float name='color1' value='0.75'/></texture>";
    const auto number = [&](const std::string& bsdf, double u, double v) {
        const SceneParts parts = read("<shape type='rectangle'>" + bsdf + "</shape>");
        const Vec3 up(0, 0, 1);
        const Bsdf& front = parts.bsdfs.at(static_cast<std::size_t>(parts.sides_of_shape.at(0).front));
        return eval(front, point_with_coordinates({u, v}), up, up).g * std::numbers::pi;
    };
    const std::string blend =
        "<bsdf type='diffuse'><float name='reflectance' value='0'/></bsdf><bsdf type='diffuse'>"
        "<float name='reflectance' value='1'/></bsdf></bsdf>";
    const auto weight = [&](double u, double v) {
        return number("<bsdf type='blendbsdf'><texture name='weight' " + board + blend, u, v);
    };
    const auto opacity = [&](double u, double v) {
        return number("<bsdf type='mask'><texture name='opacity' " + board +
                          "<bsdf type='diffuse'><float name='reflectance' value='1'/></bsdf></bsdf>",
                      u, v);
    };
    const auto reflectance = [&](double u, double v) {
        return number("<bsdf type='diffuse'><texture name='reflectance' " + board + "</bsdf>", u, v);
    };
    const auto nested = [&](double u, double v) {
        return number("<bsdf type='blendbsdf'><texture name='weight' type='checkerboard'><texture name='color0' " + board +
                          "<texture name='color1' " + board + "</texture>" + blend,
                      u, v);
    };
    const auto mean = [&](double u, double v) {
        return number(
            "<bsdf type='blendbsdf'><texture name='weight' type='checkerboard'><rgb name='color0' value='0.1, 0.3, 0.8'/>"
            "<rgb name='color1' value='0.5'/></texture>" +
                blend,
            u, v);
    };
    for (const double u : {0.2, 0.7})
        for (const double v : {0.3, 0.8}) {
            const bool same = (u > 0.5) == (v > 0.5);
            EXPECT_NEAR(weight(u, v), same ? 0.75 : 0.25, 1e-15);
            EXPECT_NEAR(opacity(u, v), same ? 0.75 : 0.25, 1e-15);
            EXPECT_NEAR(reflectance(u, v), same ? 0.25 : 0.75, 1e-15);
            EXPECT_NEAR(nested(u, v), same ? 0.75 : 0.25, 1e-15);
            EXPECT_NEAR(mean(u, v), same ? 0.5 : 0.4, 1e-15);
        }
}

TEST_F(XmlTextures, RawConstants) {
    const std::string grey = "type='rawconstant'><float name='value' value='0.3'/></texture>",
                      vector = "type='rawconstant'><vector name='value' value='0.1, 2, 0.3'/></texture>";
    EXPECT_EQ(at(rectangle("<texture name='reflectance' " + grey), 0.2, 0.3), Rgb(0.3));
    EXPECT_EQ(at(rectangle("<texture name='reflectance' " + vector), 0.2, 0.3), Rgb(0.1, 2.0, 0.3));
    EXPECT_EQ(largest_albedo(rectangle("<texture name='reflectance' " + vector).bsdfs.at(0)), Rgb(0.1, 2.0, 0.3));
    const SceneParts rough =
        read("<shape type='cube'><bsdf type='roughconductor'><texture name='alpha' " + grey + "</bsdf></shape>");
    EXPECT_EQ(lobe(rough.bsdfs.at(0)).alpha, 0.3);
    EXPECT_NO_THROW(read("<bsdf type='roughplastic'><texture name='alpha' " + grey + "</bsdf>"));
    const SceneParts light =
        read("<shape type='disk'><emitter type='area'><texture name='radiance' " + vector + "</emitter></shape>");
    EXPECT_EQ(light.lights.area.at(0).largest, Rgb(0.1, 2.0, 0.3));
    EXPECT_FALSE(light.lights.area.at(0).function);
    // A normal may have negative components.
    EXPECT_EQ(read("<shape type='cube'><bsdf type='normalmap'><texture name='normalmap' type='rawconstant'>"
                   "<vector name='value' x='0.5' y='-0.1' z='1'/></texture><bsdf type='diffuse'/></bsdf></shape>")
                  .bsdfs.size(),
              2u);
}

// Mitsuba takes a colour for a number as the mean of its channels.
TEST_F(XmlTextures, ColoursForNumbers) {
    const auto alpha = [&](const std::string& value, std::size_t warnings) {
        const SceneParts parts = read("<shape type='cube'><bsdf type='roughconductor'>" + value + "</bsdf></shape>");
        EXPECT_EQ(parts.warnings.counts().size(), warnings);
        return lobe(parts.bsdfs.at(0)).alpha;
    };
    EXPECT_EQ(alpha("<rgb name='alpha' value='0.3'/>", 0), 0.3);
    EXPECT_EQ(alpha("<spectrum name='alpha' value='0.3'/>", 0), 0.3);
    EXPECT_NEAR(alpha("<rgb name='alpha' value='0.1, 0.2, 0.6'/>", 1), 0.3, 1e-15);
}

TEST_F(XmlTextures, MeshAttributes) {
    write_colours();
    const auto seen = [&](const SceneParts& parts, const Vec3& position, std::uint32_t primitive) {
        return reflectance(parts.bsdfs.at(0), shading_point(parts.shapes.at(0), {position, {0, 0, 1}, 0.0, 0, primitive}));
    };
    const SceneParts vertices = read(coloured("vertex_color"));
    const Rgb inside = seen(vertices, {0.5, 0.25, 0.0}, 0);  // ½ (0, 0) + ¼ (1, 0) + ¼ (1, 1)
    EXPECT_NEAR(inside.r, 0.5, 1e-15);
    EXPECT_NEAR(inside.g, 0.1875, 1e-15);
    EXPECT_NEAR(inside.b, 0.25, 1e-15);
    EXPECT_EQ(largest_albedo(vertices.bsdfs[0]), Rgb(1.0, 1.0, 0.5));
    const SceneParts faces = read(coloured("face_color", "<float name='scale' value='2'/>"));
    EXPECT_EQ(seen(faces, {0.5, 0.25, 0.0}, 0), Rgb(1.0, 0.0, 0.0));
    EXPECT_EQ(seen(faces, {0.25, 0.5, 0.0}, 1), Rgb(0.0, 0.5, 0.0));
    EXPECT_EQ(largest_albedo(faces.bsdfs[0]), Rgb(1.0, 0.5, 0.0));
}

// Another texture, times a number or, for colours, a colour.
TEST_F(XmlTextures, Scaled) {
    const auto scaled = [&](const std::string& scale, const std::string& inside) {
        return rectangle("<texture name='reflectance' type='scale'>" + scale + inside + "</texture>");
    };
    const std::string board =
        "<texture type='checkerboard'><rgb name='color0' value='0.5, 0.25, 0'/><float name='color1' value='0.2'/></texture>";
    EXPECT_EQ(at(scaled("", board), 0.2, 0.2), Rgb(0.5, 0.25, 0.0));
    EXPECT_EQ(at(scaled("<float name='scale' value='2'/>", board), 0.2, 0.2), Rgb(1.0, 0.5, 0.0));
    const SceneParts parts = scaled("<rgb name='scale' value='0.5, 2, 1'/>", board);
    EXPECT_EQ(at(parts, 0.2, 0.2), Rgb(0.25, 0.5, 0.0));
    EXPECT_EQ(at(parts, 0.7, 0.2), Rgb(0.1, 0.4, 0.2));
    EXPECT_EQ(largest_albedo(parts.bsdfs.at(0)), Rgb(0.25, 0.5, 0.2));
    EXPECT_TRUE(is_constant(
        scaled("<float name='scale' value='2'/>", "<texture type='rawconstant'><float name='value' value='0.3'/></texture>")
            .bsdfs.at(0)));
    // As a number, and below a bump map, whose slopes it scales.
    const auto opacity = [&](const std::string& inside) {
        const SceneParts mask = read("<shape type='rectangle'><bsdf type='mask'><texture name='opacity' type='scale'>" + inside +
                                     "</texture><bsdf type='diffuse'><float name='reflectance' value='1'/></bsdf></bsdf></shape>");
        return eval(mask.bsdfs.at(static_cast<std::size_t>(mask.sides_of_shape.at(0).front)), point_with_coordinates({0.2, 0.2}),
                    Vec3(0, 0, 1), Vec3(0, 0, 1))
                   .g *
               std::numbers::pi;
    };
    EXPECT_NEAR(opacity("<float name='scale' value='0.5'/><texture type='checkerboard'><float name='color0' value='0.6'/>"
                        "<float name='color1' value='0.8'/></texture>"),
                0.4, 1e-15);
    const auto bumped = [&](const std::string& texture, const std::string& scale) {
        const SceneParts bump =
            read("<shape type='rectangle'><bsdf type='bumpmap'>" + texture + scale + "<bsdf type='diffuse'/></bsdf></shape>");
        return eval(bump.bsdfs.back(), point_with_coordinates({0.3, 0.3}), Vec3(0, 0, 1), Vec3(0.6, 0, 0.8));
    };
    const std::string map = "<texture type='bitmap'><string name='filename' value='four.png'/></texture>";
    EXPECT_EQ(bumped("<texture type='scale'><float name='scale' value='0.25'/>" + map + "</texture>", ""),
              bumped(map, "<float name='scale' value='0.25'/>"));
}

TEST_F(XmlTextures, ScaledErrors) {
    std::string chain = "<texture type='checkerboard' id='t0'/>";
    for (int i = 1; i < 300; ++i)
        chain += "\n<texture type='scale' id='t" + std::to_string(i) + "'><ref id='t" + std::to_string(i - 1) + "'/></texture>";
    const std::string message = error(chain + "\n<bsdf type='diffuse'><ref name='reflectance' id='t299'/></bsdf>");
    EXPECT_EQ(message.substr(message.find(": ") + 2, 38), "textures are nested more than 100 deep");
}

TEST_F(XmlTextures, AreaLights) {
    const SceneParts parts = read(
        "<shape type='rectangle'><emitter type='area'>"
        "<texture name='radiance' type='bitmap'><string name='filename' value='two.exr'/></texture>"
        "</emitter></shape>");
    EXPECT_EQ(parts.lights.area.at(0).largest, Rgb(1.0, 1.5, 2.0));
    EXPECT_EQ(parts.lights.area.at(0).function(point_with_coordinates({0.75, 0.5}), {0, 0, 1}), Rgb(1.0, 1.5, 0.0));
}

TEST_F(XmlTextures, PicturesAreInTheHash) {
    const std::string before = rectangle(bitmap("four.png")).hash;
    EXPECT_EQ(rectangle(bitmap("four.png")).hash, before);
    write_four(189);
    EXPECT_NE(rectangle(bitmap("four.png")).hash, before);
}

TEST_F(XmlTextures, NormalAndBumpMaps) {
    const std::string raw = "<boolean name='raw' value='true'/>";
    const SceneParts parts = read(
        "<shape type='rectangle'><bsdf type='twosided'><bsdf type='normalmap'><texture name='normalmap' type='bitmap'>"
        "<string name='filename' value='four.png'/>" +
        raw +
        "</texture><bsdf type='diffuse'/></bsdf></bsdf></shape>"
        "<shape type='rectangle'><bsdf type='bumpmap'><texture type='bitmap'><string name='filename' value='two.exr'/>"
        "<string name='wrap_mode' value='clamp'/></texture><float name='scale' value='0.25'/>"
        "<boolean name='use_shadowing_function' value='false'/><bsdf type='conductor'/></bsdf></shape>");
    ASSERT_EQ(parts.sides_of_shape[0].front, parts.sides_of_shape[0].back);
    const Bsdf& bumpy = parts.bsdfs.at(static_cast<std::size_t>(parts.sides_of_shape[1].front));
    EXPECT_EQ(lobe(bumpy).kind, Lobe::Kind::specular);
    EXPECT_EQ(largest_albedo(bumpy), Rgb(1.0));
    // On the ramp between the two pixels, u in [¼, ¾]: the luminance grows by its difference over half of u, which is over 1 along
    // x.
    const ShadingPoint p = shading_point(parts.shapes[1], {{0.0, 0.1, 0.0}, {0, 0, 1}, 0.0, 1, 1});
    const double slope = 0.25 * luminance(Rgb(0.75, 1.0, -2.0));
    const Vec3 n = glm::normalize(Vec3(-slope, 0.0, 1.0)), wo = glm::normalize(Vec3(-0.4, 0.2, 1.0));
    const BsdfSample s = sample(bumpy, p, wo, Vec2(0.5));
    EXPECT_NEAR(glm::length(s.wi - (2.0 * glm::dot(n, wo) * n - wo)), 0.0, 1e-14);
}

TEST_F(XmlTextures, Errors) {
    EXPECT_EQ(bitmap_error("nan.exr"), "nan.exr: the pixel in column 0 and row 0 is not finite");
    EXPECT_EQ(bitmap_error("negative.exr"),
              "scene.xml:3:1: the texture is negative somewhere, down to -0.5, expected a reflectance of at least 0");
}

// In Mitsuba 3 <texture> and <spectrum> with a type are the same.
TEST_F(XmlTextures, TexturesAndSpectraAreTheSame) {
    const std::string inside = "<string name='filename' value='four.png'/>";
    const SceneParts as_texture = rectangle(bitmap("four.png")),
                     as_spectrum = rectangle("<spectrum name='reflectance' type='bitmap'>" + inside + "</spectrum>");
    for (const double u : {0.1, 0.3, 0.6, 0.9}) EXPECT_EQ(at(as_spectrum, u, 0.4), at(as_texture, u, 0.4)) << u;
    EXPECT_EQ(at(rectangle("<spectrum name='reflectance' type='checkerboard'/>"), 0.2, 0.2),
              at(rectangle("<texture name='reflectance' type='checkerboard'/>"), 0.2, 0.2));
    const std::string half = " name='reflectance' type='uniform'><float name='value' value='0.25'/></";
    EXPECT_EQ(at(rectangle("<texture" + half + "texture>"), 0.0, 0.0), at(rectangle("<spectrum" + half + "spectrum>"), 0.0, 0.0));
    // With an id, for several materials.
    const SceneParts shared =
        read("<spectrum type='bitmap' id='four'>" + inside +
             "</spectrum><shape type='rectangle'><bsdf type='diffuse'><ref id='four' name='reflectance'/></bsdf></shape>");
    EXPECT_EQ(at(shared, 0.3, 0.4), at(as_texture, 0.3, 0.4));
}

// Each stands twice in the next: a picture a thousand textures deep would be asked for ever.
TEST_F(XmlTextures, NoDoublingWithoutEnd) {
    std::string all = "<texture type='checkerboard' id='t0'/>\n";
    for (int i = 1; i <= 30; ++i)
        all += "<texture type='checkerboard' id='t" + std::to_string(i) + "'><ref name='color0' id='t" + std::to_string(i - 1) +
               "'/><ref name='color1' id='t" + std::to_string(i - 1) + "'/></texture>\n";
    EXPECT_NE(error(all + "<shape type='cube'><bsdf type='diffuse'><ref name='reflectance' id='t30'/></bsdf></shape>")
                  .find("a texture is made of more than 1024 textures"),
              std::string::npos);
}

}  // namespace neumann::xml_textures_test
