// Lights: pbrt files and Mitsuba files that say the same, and light by the numbers that pbrt promises.
#include "core/reader/formats/pbrt/octahedral.h"
#include "core/sampling/warp.h"
#include "tests/reader/pbrt_scene_files.h"

#include <fmt/format.h>

namespace neumann::pbrt_lights_test {

class PbrtLights : public PbrtTest {
protected:
    static std::string rgb(const std::string& name, double r, double g, double b) {
        return fmt::format("<rgb name='{}' value='{}, {}, {}'/>", name, r, g, b);
    }
    static constexpr const char* grey = "<bsdf type='twosided'><bsdf type='diffuse'/></bsdf>";
    static std::string lamp(const std::string& radiance) {
        return std::string("<shape type='sphere'>") + grey + "<emitter type='area'>" + radiance + "</emitter></shape>";
    }
    static Rgb radiance_of(const SceneParts& parts, std::size_t shape) {
        return parts.lights.area.at(static_cast<std::size_t>(parts.lights.of_shape.at(shape))).largest;
    }
};

TEST_F(PbrtLights, AreaLights) {
    const std::string sphere = "\nShape \"sphere\"";
    expect_same("AreaLightSource \"diffuse\"" + sphere, lamp(rgb("radiance", 1, 1, 1)));
    expect_same("AreaLightSource \"diffuse\" \"rgb L\" [1 2 3] \"float scale\" 2" + sphere, lamp(rgb("radiance", 2, 4, 6)));
    // The power of a sphere of radius 1 is π A L.
    expect_same("AreaLightSource \"diffuse\" \"rgb L\" [1 0.5 0.5] \"float power\" 100" + sphere,
                lamp(rgb("radiance", 100 / (4 * pi * pi), 50 / (4 * pi * pi), 50 / (4 * pi * pi))));
    // AttributeEnd ends it.
    EXPECT_EQ(read_pbrt("AttributeBegin AreaLightSource \"diffuse\" AttributeEnd Shape \"sphere\"").lights.of_shape.at(0),
              Emitters::none);
}

// pbrt counts each triangle as a light of the whole power.
TEST_F(PbrtLights, PowerOfMeshes) {
    const SceneParts even = read_pbrt(
        "AreaLightSource \"diffuse\" \"float power\" 10\nScale 2 2 2 Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 0] "
        "\"integer "
        "indices\" [0 1 2 0 2 3]");
    ASSERT_EQ(even.shapes.size(), 1u);
    EXPECT_NEAR(radiance_of(even, 0).g, 10.0 / (pi * 2.0), 1e-12);
    const SceneParts uneven = read_pbrt(
        "AreaLightSource \"diffuse\" \"float power\" 10\nShape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 3 0] \"integer "
        "indices\" "
        "[0 1 2 0 2 3]");
    ASSERT_EQ(uneven.shapes.size(), 2u);
    EXPECT_NEAR(radiance_of(uneven, 0).g, 10.0 / (pi * 0.5), 1e-12);
    EXPECT_NEAR(radiance_of(uneven, 1).g, 10.0 / (pi * 1.5), 1e-12);
    // A patch is one light.
    const SceneParts patch =
        read_pbrt("AreaLightSource \"diffuse\" \"float power\" 10\nShape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]");
    EXPECT_NEAR(radiance_of(patch, 0).g, 10.0 / pi, 1e-12);
}

TEST_F(PbrtLights, LightsOfTwoSides) {
    for (const std::string shape : {"Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]", "Shape \"disk\"", "Shape \"sphere\"",
                                    "ReverseOrientation Shape \"disk\"",
                                    "ReverseOrientation Scale 1 1 -1 Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]",
                                    "Scale 1 1 -1 Shape \"sphere\""}) {
        SCOPED_TRACE(shape);
        const SceneParts parts = read_pbrt("AreaLightSource \"diffuse\" \"bool twosided\" true \"float power\" 3\n" + shape);
        EXPECT_EQ(warning(parts), "light that shines from both sides: two lights, a ten-thousandth of their size apart");
        ASSERT_EQ(parts.shapes.size(), 2u);
        EXPECT_EQ(radiance_of(parts, 0), radiance_of(parts, 1));
        const Scene scene = make_scene(read_pbrt("AreaLightSource \"diffuse\" \"bool twosided\" true\n" + shape));
        // What comes from far away meets a light that shines at it, from wherever.
        for (const double side : {1.0, -1.0}) {
            SurfacePoint hit;
            const Vec3 towards(0.0, 0.0, -side), origin = Vec3(0.2, 0.2, 0.0) - 5.0 * towards;
            ASSERT_TRUE(scene.geometry.first_hit(origin, towards, 100.0, hit));
            EXPECT_EQ(scene.emitters.emitted(hit, -towards), Rgb(1.0)) << side;
        }
    }
}

TEST_F(PbrtLights, PicturesOnLights) {
    write("a.ppm", "P3 2 2 255\n255 0 0  0 255 0  0 0 255  128 128 128\n");
    expect_same("AreaLightSource \"diffuse\" \"string filename\" \"a.ppm\"\nShape \"sphere\"",
                lamp("<texture type='bitmap' name='radiance'><string name='filename' value='a.ppm'/><string name='filter_type' "
                     "value='nearest'/></texture>"));
    const SceneParts bright =
        read_pbrt("AreaLightSource \"diffuse\" \"string filename\" \"a.ppm\" \"float scale\" 3\nShape \"sphere\"");
    expect_near(radiance_of(bright, 0), Rgb(3.0), 1e-6, "scaled");
}

TEST_F(PbrtLights, PointLights) {
    expect_same("Translate 1 0 0 LightSource \"point\" \"rgb I\" [1 2 3] \"float scale\" 2 \"point3 from\" [0 1 0]",
                "<emitter type='point'><point name='position' x='1' y='1' z='0'/>" + rgb("intensity", 2, 4, 6) + "</emitter>");
    expect_same("LightSource \"point\" \"float power\" 8",
                "<emitter type='point'>" + rgb("intensity", 2 / pi, 2 / pi, 2 / pi) + "</emitter>");
    expect_same(
        "Rotate 90 0 1 0 LightSource \"distant\" \"rgb L\" [1 2 3] \"point3 from\" [0 0 5] \"point3 to\" [0 0 1]",
        "<emitter type='directional'><vector name='direction' x='-1' y='0' z='0'/>" + rgb("irradiance", 1, 2, 3) + "</emitter>");
    expect_same(
        "LightSource \"distant\" \"float illuminance\" 7",
        "<emitter type='directional'><vector name='direction' x='0' y='0' z='1'/>" + rgb("irradiance", 7, 7, 7) + "</emitter>");
    const std::string cone =
        "<float name='cutoff_angle' value='40'/><float name='beam_width' value='30'/>"
        "<string name='falloff' value='smooth'/>";
    expect_same(
        "Scale 2 2 2 LightSource \"spot\" \"point3 from\" [0 0 1] \"point3 to\" [0 0 3] \"float coneangle\" 40 \"float "
        "conedeltaangle\" 10",
        "<emitter type='spot'><transform name='to_world'><translate z='2'/></transform>" + rgb("intensity", 1, 1, 1) + cone +
            "</emitter>");
    const double power = 5.0 / (2.0 * pi * (1.0 - 0.5 * (std::cos(glm::radians(30.0)) + std::cos(glm::radians(40.0)))));
    expect_same("LightSource \"spot\" \"float power\" 5 \"float coneangle\" 40 \"float conedeltaangle\" 10",
                "<emitter type='spot'>" + rgb("intensity", power, power, power) + cone + "</emitter>");
    EXPECT_EQ(warning(read_pbrt("LightSource \"spot\"")), "");
    // I s(cos θ) / d² at the distance d, s pbrt's SmoothStep from the edge of the cone to where it begins to fall off.
    const SceneParts spot = read_pbrt("LightSource \"spot\" \"float coneangle\" 40 \"float conedeltaangle\" 30");
    const double edge = std::cos(glm::radians(40.0)), begin = std::cos(glm::radians(10.0));
    for (const double degrees : {5.0, 15.0, 25.0, 35.0, 39.0, 41.0}) {
        const double cosine = std::cos(glm::radians(degrees)), x = std::clamp((cosine - edge) / (begin - edge), 0.0, 1.0);
        const Vec3 at = 2.0 * Vec3(std::sin(glm::radians(degrees)), 0.0, cosine);
        const auto beam = std::visit([&](const auto& light) { return light.beam(at, {}); }, spot.lights.delta.at(0));
        EXPECT_NEAR(beam.irradiance.g, x * x * (3.0 - 2.0 * x) / 4.0, 1e-14) << degrees;
    }
}

TEST_F(PbrtLights, Colours) {
    const auto radiance = [&](const std::string& colour) {
        return std::get<ConstantEnvironment>(*read_pbrt("LightSource \"infinite\" " + colour).lights.environment).radiance({});
    };
    const auto luminance = [](const Rgb& c) { return 0.212671 * c.r + 0.715160 * c.g + 0.072169 * c.b; };
    EXPECT_EQ(radiance(""), Rgb(1.0));
    EXPECT_EQ(radiance("\"rgb L\" [1 2 3] \"float scale\" 2"), Rgb(2.0, 4.0, 6.0));
    EXPECT_EQ(radiance("\"spectrum L\" \"stdillum-D65\""), Rgb(1.0));
    expect_near(radiance("\"rgb L\" [1 2 3] \"float illuminance\" 5"), Rgb(1.0, 2.0, 3.0) * (5.0 / pi), 1e-12, "illuminance");
    // Of spectra only the colour counts: their luminance is 1, however large their values.
    for (const std::string colour :
         {"\"blackbody L\" 6500", "\"blackbody L\" 2856", "\"spectrum L\" [400 1 700 1]", "\"spectrum L\" [400 50 700 50]",
          "\"spectrum L\" \"stdillum-F2\"", "\"spectrum L\" \"stdillum-A\""})
        EXPECT_NEAR(luminance(radiance(colour)), 1.0, 1e-4) << colour;
    // Illuminant A is Planck's at 2848 K by today's constants to about 10 K.
    expect_near(radiance("\"blackbody L\" 2856"), radiance("\"spectrum L\" \"stdillum-A\""), 5e-3, "illuminant A");
}

// ISO and the time that the shutter is open multiply what the film sees; here the lights are as much brighter.
TEST_F(PbrtLights, ImagingRatio) {
    const SceneParts parts = read_pbrt_file(
        "Film \"rgb\" \"float iso\" 200\nCamera \"perspective\" \"float shutteropen\" 0.25 \"float shutterclose\" 0.5\nWorldBegin\n"
        "LightSource \"infinite\"\nLightSource \"point\"\nLightSource \"distant\"\nAreaLightSource \"diffuse\" Shape \"sphere\"");
    const Surroundings around;
    EXPECT_EQ(std::get<ConstantEnvironment>(*parts.lights.environment).radiance({}), Rgb(0.5));
    EXPECT_EQ(beam(parts.lights.delta.at(0), Vec3(1, 0, 0), around).irradiance, Rgb(0.5));
    EXPECT_EQ(beam(parts.lights.delta.at(1), Vec3(1, 0, 0), around).irradiance, Rgb(0.5));
    EXPECT_EQ(radiance_of(parts, 0), Rgb(0.5));
}

TEST_F(PbrtLights, OctahedralPictures) {
    using namespace reader::pbrt;
    // Poles, axes and corners; equal areas; the inverse.
    expect_near(direction_of_square({0.5, 0.5}), Vec3(0, 0, 1), 1e-12, "middle");
    expect_near(direction_of_square({1.0, 0.5}), Vec3(1, 0, 0), 1e-12, "right");
    expect_near(direction_of_square({0.5, 1.0}), Vec3(0, 1, 0), 1e-12, "below");
    expect_near(direction_of_square({0.0, 0.0}), Vec3(0, 0, -1), 1e-12, "corner");
    Vec3 sum(0.0), squares(0.0);
    constexpr int n = 200;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const Vec2 p((x + 0.5) / n, (y + 0.5) / n);
            const Vec3 w = direction_of_square(p);
            ASSERT_NEAR(glm::length(w), 1.0, 1e-12);
            const Vec2 q = square_of_direction(w);
            ASSERT_NEAR(glm::distance(p, q), 0.0, 1e-9) << x << ' ' << y;
            sum += w;
            squares += w * w;
        }
    expect_near(sum / double(n * n), Vec3(0.0), 1e-4, "mean direction");
    expect_near(squares / double(n * n), Vec3(1.0 / 3.0), 1e-4, "mean square: areas are equal");

    // Four colours, one a quadrant: right and left of x = 0, in front of and behind y = 0.
    write("sky.ppm", "P3 2 2 255\n255 0 0  0 255 0  0 0 255  255 255 255\n");
    const SceneParts parts = read_pbrt("LightSource \"infinite\" \"string filename\" \"sky.ppm\" \"float scale\" 2");
    const auto at = [&](const Vec3& w) { return radiance(*parts.lights.environment, glm::normalize(w)); };
    for (const double z : {0.2, -0.3}) {
        expect_near(at({-1, -1, z}), Rgb(2, 0, 0), 1e-6, "−x −y");
        expect_near(at({1, -1, z}), Rgb(0, 2, 0), 1e-6, "+x −y");
        expect_near(at({-1, 1, z}), Rgb(0, 0, 2), 1e-6, "−x +y");
        expect_near(at({1, 1, z}), Rgb(2, 2, 2), 1e-6, "+x +y");
    }
    // The sky turns with the transformation.
    const SceneParts turned = read_pbrt("Rotate -90 1 0 0 Scale -1 1 1 LightSource \"infinite\" \"string filename\" \"sky.ppm\"");
    const auto turned_at = [&](const Vec3& w) { return radiance(*turned.lights.environment, glm::normalize(w)); };
    expect_near(turned_at({1, 0.2, 1}), Rgb(1, 0, 0), 1e-6, "−x −y, which is now +x +z");
    expect_near(turned_at({1, 0.2, -1}), Rgb(0, 0, 1), 1e-6, "−x +y, which is now +x −z");
}

// Six projectors, of which each direction gets light from one. In pbrt the picture's middle is +y, and its y axis is +z.
TEST_F(PbrtLights, Goniometric) {
    write("lamp.ppm", "P3 2 2 255\n255 255 255  0 0 0  255 255 0  51 102 153\n");  // means 1, 0, 2/3, 0.4
    const SceneParts parts =
        read_pbrt("Translate 1 2 3 LightSource \"goniometric\" \"string filename\" \"lamp.ppm\" \"rgb I\" [2 4 6]");
    ASSERT_EQ(parts.lights.delta.size(), 6u);
    EXPECT_EQ(warning(parts), "goniometric light: six projectors, to whose pixels its picture is resampled");
    const Surroundings around{Vec3(0.0), 10.0};
    const Vec3 position(1, 2, 3);
    const auto intensity = [&](const SceneParts& of, const Vec3& w) {
        Rgb sum(0.0);
        for (const DeltaLight& light : of.lights.delta) sum += beam(light, position + w * 2.0, around).irradiance;
        return sum * 4.0 * glm::dot(w, w);
    };
    const double mean_byte = std::pow((102.0 / 255.0 + 0.055) / 1.055, 2.4),
                 dark =
                     (std::pow((51.0 / 255.0 + 0.055) / 1.055, 2.4) + mean_byte + std::pow((153.0 / 255.0 + 0.055) / 1.055, 2.4)) /
                     3.0;
    for (const double y : {0.2, -0.3, 2.0, -2.0})
        for (const double x : {0.5, 1.0}) {
            const auto w = [&](double sx, double sz) { return glm::normalize(Vec3(sx * x, y, sz * 0.7)); };
            expect_near(intensity(parts, w(-1, -1)), Rgb(2, 4, 6), 2e-4, "−x −z");
            expect_near(intensity(parts, w(1, -1)), Rgb(0.0), 1e-9, "+x −z");
            expect_near(intensity(parts, w(-1, 1)), Rgb(2, 4, 6) * (2.0 / 3.0), 2e-4, "−x +z");
            expect_near(intensity(parts, w(1, 1)), Rgb(2, 4, 6) * dark, 2e-4, "+x +z");
        }
    // π times the brightness, the mean of the channels; with a power of 5 the luminance of I is 5 / (4π mean) of that.
    const auto power = [&](const SceneParts& of) {
        double sum = 0.0;
        for (const DeltaLight& light : of.lights.delta) sum += pi * brightness(light, around);
        return sum;
    };
    const double mean = (1.0 + 2.0 / 3.0 + dark) / 4.0;
    EXPECT_NEAR(power(parts), 4.0 * 4.0 * pi * mean, 1e-3 * 16.0 * pi * mean);
    const SceneParts given = read_pbrt(
        "LightSource \"goniometric\" \"string filename\" \"lamp.ppm\" \"rgb I\" [1 1 1] \"float power\" 5 \"float scale\" 1");
    EXPECT_NEAR(power(given), 5.0, 5e-3);
}

}  // namespace neumann::pbrt_lights_test
