// Lights that stand on no shape: what the reader makes of them, and what it refuses.
#include "core/emitter/sun_position.h"
#include "core/emitter/sun_radiance.h"
#include "core/image/image_io.h"
#include "core/reader/convert_scene.h"
#include "core/sampling/warp.h"
#include "tests/reader/xml_scene_files.h"

namespace neumann::xml_lights_test {

class XmlLights : public XmlTest {
protected:
    SceneParts light(const std::string& type, const std::string& inside) const {
        return read("<emitter type='" + type + "'>" + inside + "</emitter>");
    }
    // Per area across the beam, at a point.
    Rgb arrives(const std::string& type, const std::string& inside, const Vec3& at) const {
        return beam(light(type, inside).lights.delta.at(0), at, {}).irradiance;
    }
    Rgb surrounds(const std::string& type, const std::string& inside, const Vec3& from) const {
        return radiance(light(type, inside).lights.environment.value(), from);
    }
    std::string light_error(const std::string& type, const std::string& inside) const {
        return error("<emitter type='" + type + "'>\n" + inside + "</emitter>");
    }
    // Grey, row by row.
    void write_exr(const std::string& name, int width, const std::vector<double>& values) const {
        Image image(width, static_cast<int>(values.size()) / width);
        for (std::size_t i = 0; i < values.size(); ++i) image.pixels[i] = Rgb(values[i]);
        write(name, encode_exr(Estimate{image, {}}));
    }
};

constexpr const char* quarter_turn = "<transform name='to_world'><rotate y='1' angle='90'/></transform>";  // takes +z to +x
constexpr const char* slide =
    "<texture type='bitmap' name='texture'><string name='filename' value='a.exr'/>"
    "<string name='filter_type' value='nearest'/></texture>";

TEST_F(XmlLights, Constant) {
    EXPECT_EQ(surrounds("constant", "", {0, 1, 0}), Rgb(1.0));
    EXPECT_EQ(surrounds("constant", "<rgb name='radiance' value='1, 2, 3'/>", {0, 0, 1}), Rgb(1.0, 2.0, 3.0));
    EXPECT_TRUE(light("constant", "").lights.delta.empty());
}

TEST_F(XmlLights, Point) {
    EXPECT_EQ(arrives("point", "", {0, 2, 0}), Rgb(0.25));
    EXPECT_EQ(arrives("point", "<point name='position' x='1' y='0' z='0'/><rgb name='intensity' value='4, 8, 12'/>", {1, 2, 0}),
              Rgb(1.0, 2.0, 3.0));
    EXPECT_EQ(arrives("point", "<transform name='to_world'><translate x='1'/></transform>", {1, 2, 0}), Rgb(0.25));
}

TEST_F(XmlLights, Directional) {
    const auto from = [&](const std::string& inside) {
        return glm::normalize(beam(light("directional", inside).lights.delta.at(0), {}, {}).from);
    };
    EXPECT_NEAR(glm::distance(from(""), Vec3(0, 0, -1)), 0.0, 1e-15);
    EXPECT_NEAR(glm::distance(from("<vector name='direction' x='3' y='0' z='-4'/>"), Vec3(-0.6, 0, 0.8)), 0.0, 1e-15);
    EXPECT_NEAR(glm::distance(from(quarter_turn), Vec3(-1, 0, 0)), 0.0, 1e-15);
    EXPECT_EQ(arrives("directional", "<float name='irradiance' value='3'/><float name='sampling_weight' value='2'/>", {1, 2, 3}),
              Rgb(3.0));
}

TEST_F(XmlLights, Spot) {
    const auto at_angle = [](double degrees) {
        const double a = degrees * pi / 180.0;
        return Vec3(std::sin(a), 0.0, std::cos(a));
    };
    // 20° and three quarters of it.
    for (const auto& [degrees, part] : {std::pair(14.9, 1.0), {17.5, 0.5}, {19.0, 0.2}, {20.1, 0.0}})
        EXPECT_NEAR(arrives("spot", "", at_angle(degrees)).r, part, 1e-12) << degrees;
    EXPECT_NEAR(arrives("spot", "<float name='cutoff_angle' value='60'/><float name='beam_width' value='10'/>", at_angle(35.0)).r,
                0.5, 1e-12);
    EXPECT_NEAR(arrives("spot", std::string(quarter_turn) + "<rgb name='intensity' value='1 2 3'/>", {2, 0, 0}).b, 0.75, 1e-15);

    write_exr("a.exr", 2, {1.0, 2.0});
    EXPECT_NEAR(arrives("spot", slide, {-0.1, 0, 1}).r, 1.0 / 1.01, 1e-12);
    EXPECT_NEAR(arrives("spot", slide, {0.1, 0, 1}).r, 2.0 / 1.01, 1e-12);
    const SceneParts parts = read(
        "<texture type='bitmap' id='t'><string name='filename' value='a.exr'/></texture>"
        "<emitter type='spot'><ref name='texture' id='t'/></emitter>");
    EXPECT_NEAR(beam(parts.lights.delta.at(0), {0, 0, 1}, {}).irradiance.r, 1.5, 1e-12);

    write_exr("negative.exr", 2, {1.0, -2.0});
    EXPECT_EQ(light_error("spot", "<texture type='bitmap' name='texture'><string name='filename' value='negative.exr'/></texture>"),
              "scene.xml:3:1: the texture is negative somewhere, down to -2, expected a texture of at least 0");
}

// Any texture over the unit square, and it may be stretched.
TEST_F(XmlLights, ASlideIsATexture) {
    const std::string board =
        "<texture type='checkerboard' name='texture'><float name='color0' value='3'/><float name='color1' value='5'/>";
    EXPECT_NEAR(arrives("spot", board + "</texture>", {0.1, 0.1, 1}).r, 3.0 / 1.02, 1e-12);
    EXPECT_NEAR(arrives("spot", board + "</texture>", {-0.1, 0.1, 1}).r, 5.0 / 1.02, 1e-12);
    EXPECT_NEAR(arrives("spot", board + "<transform name='to_uv'><translate x='0.5'/></transform></texture>", {0.1, 0.1, 1}).r,
                5.0 / 1.02, 1e-12);
    EXPECT_TRUE(is_grey(light("spot", board + "</texture>").lights.delta.at(0)));
    EXPECT_FALSE(is_grey(light("spot", board + "</texture><rgb name='intensity' value='1 2 1'/>").lights.delta.at(0)));
}

TEST_F(XmlLights, Projector) {
    // Half of 90° is 45°: the picture at z = 1 is 2 wide. On the axis π E arrives.
    const std::string wide = "<float name='fov' value='90'/>";
    EXPECT_NEAR(arrives("projector", wide + "<rgb name='irradiance' value='2'/><float name='scale' value='3'/>", {0.9, 0.9, 1}).r,
                6.0 * pi * std::sqrt(1.0 + 2.0 * 0.81), 1e-12);
    EXPECT_EQ(arrives("projector", wide + "<rgb name='irradiance' value='2'/>", {1.1, 0, 1}), Rgb(0.0));
    write_exr("a.exr", 2, {1.0, 2.0});
    const std::string picture =
        "<texture type='bitmap' name='irradiance'><string name='filename' value='a.exr'/>"
        "<string name='wrap_mode' value='clamp'/></texture>";
    EXPECT_NEAR(arrives("projector", wide + picture, {0.8, 0, 1}).r, pi * std::sqrt(1.64), 1e-12);  // +x is left
    EXPECT_NEAR(arrives("projector", wide + picture, {-0.8, 0, 1}).r, 2.0 * pi * std::sqrt(1.64), 1e-12);
    EXPECT_EQ(arrives("projector", wide + picture, {0, 0.51, 1}), Rgb(0.0));
    // A lens of 50 mm before 36 mm × 24 mm, along the diagonal: tan of half of it is √1872/100, of which a picture of 2 × 1 has
    // 2/√5 across.
    const double half_width = std::sqrt(1872.0) / 100.0 * 2.0 / std::sqrt(5.0);
    EXPECT_NE(arrives("projector", picture, {0.999 * half_width, 0, 1}), Rgb(0.0));
    EXPECT_EQ(arrives("projector", picture, {1.001 * half_width, 0, 1}), Rgb(0.0));
}

TEST_F(XmlLights, EnvironmentMap) {
    write_exr("a.exr", 4, {9, 9, 9, 9, 1, 2, 3, 4, 7, 7, 7, 7});
    const std::string file = "<string name='filename' value='a.exr'/>";
    EXPECT_NEAR(surrounds("envmap", file, {0, 1, 0}).r, 9.0, 1e-12);
    EXPECT_NEAR(surrounds("envmap", file, {0, -1, 0}).r, 7.0, 1e-12);
    // The first pixel of the middle row is at φ = 45° from −z to +x.
    const double s = std::sqrt(0.5);
    EXPECT_NEAR(surrounds("envmap", file, {s, 0, -s}).r, 1.0, 1e-12);
    EXPECT_NEAR(surrounds("envmap", file, {s, 0, s}).r, 2.0, 1e-12);
    EXPECT_NEAR(
        surrounds("envmap", file + "<float name='scale' value='5'/><boolean name='mis_compensation' value='true'/>", {-s, 0, s}).r,
        15.0, 1e-12);
    EXPECT_NEAR(surrounds("envmap", file + quarter_turn, {-s, 0, -s}).r, 1.0, 1e-12);  // −z goes to −x

    write_exr("negative.exr", 2, {1, 2, 3, -4, 5, 6});
    EXPECT_EQ(light_error("envmap", "<string name='filename' value='negative.exr'/>"),
              "scene.xml:3:25: pixel (1, 1) of 'negative.exr' is (-4, -4, -4), expected numbers that are not negative");
}

// The first row is the pole above, and the last one, which comes again down to the third, that below; radiance is linear between.
TEST_F(XmlLights, SmallEnvironmentMaps) {
    const double s = std::sqrt(0.5);
    const Vec3 above(0, s, -s), level(0, 0, -1), below(0, -s, -s);
    const auto looks = [&](int width, const std::vector<double>& pixels, const Vec3& w) {
        write_exr("small.exr", width, pixels);
        return surrounds("envmap", "<string name='filename' value='small.exr'/>", w).r;
    };
    for (const Vec3& w : {above, level, below, Vec3(1, 0, 0)}) EXPECT_NEAR(looks(1, {3}, w), 3.0, 1e-12);
    EXPECT_NEAR(looks(1, {2, 6}, above), 4.0, 1e-12);
    EXPECT_NEAR(looks(1, {2, 6}, level), 6.0, 1e-12);
    EXPECT_NEAR(looks(1, {2, 6}, below), 6.0, 1e-12);
    // In the middle of the first of four pixels, and half way to the second.
    EXPECT_NEAR(looks(4, {1, 2, 3, 4}, {s, 0, -s}), 1.0, 1e-12);
    EXPECT_NEAR(looks(4, {1, 2, 3, 4}, {1, 0, 0}), 1.5, 1e-12);
    EXPECT_NEAR(looks(2, {1, 5}, {1, 0, 0}), 1.0, 1e-12);
}

// Above +z, or where to_world turns it.
TEST_F(XmlLights, SunSky) {
    const auto around = [&](const std::string& inside) { return light("sunsky", inside).lights.environment.value(); };
    const auto warnings = [&](const std::string& inside) { return light("sunsky", inside).warnings.counts(); };
    const std::string preetham = "sunsky: the sun is that of Preetham, Shirley and Smits (1999) in place of Mitsuba's tables",
                      upwards = "<vector name='sun_direction' x='0' y='3' z='4'/>", no_sun = "<float name='sun_scale' value='0'/>";
    const Vec3 sun(0.0, 0.6, 0.8), elsewhere = glm::normalize(Vec3(1, 2, 3));
    const double elevation = std::asin(0.8);

    const SkyModel sky(3.0, Rgb(0.3), elevation);
    const auto expect_near = [](const Rgb& a, const Rgb& b) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-9 * (1.0 + b[c]));
    };
    expect_near(surrounds("sunsky", upwards, elsewhere), sky.radiance(elsewhere.z, glm::dot(elsewhere, sun)));
    expect_near(surrounds("sunsky", upwards + no_sun, sun), sky.radiance(0.8, 1.0));
    const Rgb disc = spectrum_to_rgb(sun_spectrum(3.0, elevation), Illuminant::equal_energy);
    expect_near(surrounds("sunsky", upwards, sun), disc + sky.radiance(0.8, 1.0));
    EXPECT_EQ(surrounds("sunsky", upwards, {0, 0, -1}), Rgb(0.0));
    // The same power from a larger disc, and the scales.
    const double wider = (1.0 - std::cos(0.5 * glm::radians(sun_angle))) / (1.0 - std::cos(glm::radians(5.0)));
    expect_near(
        surrounds("sunsky",
                  upwards +
                      "<float name='sun_aperture' value='10'/><float name='sun_scale' value='3'/>"
                      "<float name='sky_scale' value='2'/><float name='turbidity' value='5'/><rgb name='albedo' value='0.1'/>",
                  sun),
        spectrum_to_rgb(sun_spectrum(5.0, elevation), Illuminant::equal_energy) * (3.0 * wider) +
            SkyModel(5.0, Rgb(0.1), elevation).radiance(0.8, 1.0) * 2.0);
    // Upright in a space where +y is up; the sun's direction is the world's.
    const std::string y_up = "<transform name='to_world'><rotate x='1' angle='-90'/></transform>";
    expect_near(surrounds("sunsky", y_up + "<vector name='sun_direction' x='0' y='4' z='-3'/>" + no_sun, {0, 1, 0}),
                sky.radiance(1.0, 0.8));

    // Tokyo on an afternoon, if nothing is said; north is −x and east −y.
    const SunPosition tokyo = sun_position({35.6894, 139.6917, 9.0, std::chrono::year(2010) / 7 / 10, 15.0, 0.0, 0.0});
    const Vec3 there(-std::sin(tokyo.zenith_angle) * std::cos(tokyo.azimuth),
                     -std::sin(tokyo.zenith_angle) * std::sin(tokyo.azimuth), std::cos(tokyo.zenith_angle));
    EXPECT_GT(radiance(around(""), there).r, 1e4);
    EXPECT_LT(radiance(around(""), glm::normalize(there + Vec3(0, 0, 0.01))).r, 1e2);
    EXPECT_GT(there.x, 0.0);
    EXPECT_GT(there.y, 0.0);
    const std::string elsewhen =
        "<float name='latitude' value='-33.9'/><float name='longitude' value='18.4'/><float name='timezone' value='2'/>"
        "<integer name='year' value='2012'/><integer name='month' value='2'/><integer name='day' value='29'/>"
        "<integer name='hour' value='9'/><float name='minute' value='30'/><float name='second' value='15'/>";
    const SunPosition cape = sun_position({-33.9, 18.4, 2.0, std::chrono::year(2012) / 2 / 29, 9.0, 30.0, 15.0});
    EXPECT_GT(radiance(around(elsewhen), {-std::sin(cape.zenith_angle) * std::cos(cape.azimuth),
                                          -std::sin(cape.zenith_angle) * std::sin(cape.azimuth), std::cos(cape.zenith_angle)})
                  .r,
              1e4);

    EXPECT_EQ(warnings(upwards), (Warnings::Counts{{preetham, 1}}));
    EXPECT_EQ(warnings(upwards + no_sun), (Warnings::Counts{}));
    EXPECT_EQ(warnings("<vector name='sun_direction' x='1' y='0' z='0'/>"),
              (Warnings::Counts{{preetham, 1}, {"sunsky: the sun is redder than the colours of sRGB, cut to them", 1}}));
    const std::string at_night = "<vector name='sun_direction' x='1' y='0' z='-0.1'/>";
    EXPECT_EQ(
        warnings(at_night),
        (Warnings::Counts{{"sunsky: the sun is below the horizon, and there is no light from the sky either, as in Mitsuba", 1}}));
    EXPECT_EQ(largest(around(at_night)), Rgb(0.0));
    EXPECT_EQ(largest(around(upwards + no_sun + "<float name='sky_scale' value='0'/>")), Rgb(0.0));
}

TEST_F(XmlLights, ASunSkyIsConvertedAsItCame) {
    write("scene.xml",
          scene("<emitter type='sunsky'><float name='turbidity' value='4'/><integer name='hour' value='9'/></emitter>"));
    const std::string xml = convert_scene(path("scene.xml")).xml;
    EXPECT_NE(xml.find("<emitter type=\"sunsky\">"), std::string::npos) << xml;
    EXPECT_NE(xml.find("<float name=\"turbidity\" value=\"4\" />"), std::string::npos) << xml;
    EXPECT_NE(xml.find("<integer name=\"hour\" value=\"9\" />"), std::string::npos) << xml;
}

// Bytes are decoded as sRGB unless they are raw; alpha does not count.
TEST_F(XmlLights, BytesAreDecoded) {
    DisplayImage grey(4, 3, 188);
    write("a.png", encode_png(grey));
    const double byte = 188.0 / 255.0, decoded = std::pow((byte + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(surrounds("envmap", "<string name='filename' value='a.png'/>", {0, 1, 0}).r, decoded, 1e-7);
    const std::string texture = "<texture type='bitmap' name='texture'><string name='filename' value='a.png'/>";
    EXPECT_NEAR(arrives("spot", texture + "</texture>", {0, 0, 1}).g, decoded, 1e-7);
    EXPECT_NEAR(arrives("spot", texture + "<boolean name='raw' value='true'/></texture>", {0, 0, 1}).g, byte, 1e-7);
}

TEST_F(XmlLights, PicturesAreInTheHash) {
    const std::string scene = "<emitter type='envmap'><string name='filename' value='a.exr'/></emitter>";
    write_exr("a.exr", 2, {1, 2, 3, 4, 5, 6});
    const std::string first = read(scene).hash;
    EXPECT_EQ(read(scene).hash, first);
    write_exr("a.exr", 2, {1, 2, 3, 4, 5, 7});
    EXPECT_NE(read(scene).hash, first);
}

TEST_F(XmlLights, SeveralAndOneThatSurrounds) {
    const SceneParts parts = read(
        "<emitter type='point'/><shape type='cube'><ref id='lamp'/></shape><emitter type='area' id='lamp'>"
        "<float name='radiance' value='3'/></emitter><emitter type='directional'/><emitter type='constant'/>");
    EXPECT_EQ(parts.lights.delta.size(), 2u);
    EXPECT_EQ(parts.lights.area.size(), 1u);
}

// On a shape, or referred to by several; what shines is the shape, so the element alone is no light.
TEST_F(XmlLights, DirectionalArea) {
    const std::string red = "<emitter type='directionalarea' id='red'><rgb name='radiance' value='3, 2, 1'/></emitter>";
    const SceneParts parts = read(red +
                                  "<shape type='disk'><ref id='red'/></shape><shape type='rectangle'><ref id='red'/></shape>"
                                  "<shape type='disk'><emitter type='directionalarea'/></shape>");
    ASSERT_EQ(parts.lights.of_shape.size(), 3u);
    EXPECT_EQ(parts.lights.of_shape[0], parts.lights.of_shape[1]);
    const auto light = [&](std::size_t shape) {
        return parts.lights.area.at(static_cast<std::size_t>(parts.lights.of_shape[shape]));
    };
    EXPECT_TRUE(light(0).along_normal);
    EXPECT_EQ(light(0).largest, Rgb(3, 2, 1));
    EXPECT_EQ(light(2).largest, Rgb(1.0));
    EXPECT_EQ(parts.sides_of_shape[0].front, Materials::absorbing);
    const Scene scene = make_scene(read("<shape type='disk'>" + red + "</shape>"));
    EXPECT_EQ(scene.emitters.sample_distant(0, {0.3, 0.2, 5}, {}).light, Rgb(3, 2, 1));
    EXPECT_EQ(scene.emitters.sample_distant(0, {0.9, 0.9, 5}, {}).light, Rgb(0.0));
}

}  // namespace neumann::xml_lights_test
