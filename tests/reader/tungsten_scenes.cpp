// Where things stand in Tungsten's scenes, what is seen of them, and how many bounces there are.
#include "core/geometry/shading_point.h"
#include "core/reader/formats/tungsten/transforms.h"
#include "tests/reader/gltf_scene_files.h"
#include "tests/reader/tungsten_scene_files.h"

#include <cmath>
#include <numbers>

namespace neumann::tungsten_scenes_test {

constexpr double pi = std::numbers::pi;

class TungstenScenes : public TungstenTest {
protected:
    static Mat4 transform(const Json& given) {
        Warnings warnings;
        reader::Problems problems;
        reader::Notes notes{warnings, problems};
        const Json parent = {{"transform", given}};
        reader::JsonObject object(parent, {"scene.json"}, notes);
        const Mat4 m = reader::tungsten::read_transform(object);
        problems.check({"scene.json"});
        return m;
    }
    static void expect_columns(const Json& given, const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& position = Vec3(0.0)) {
        const Mat4 m = transform(given);
        expect_near(Vec3(m[0]), x, 1e-12, given.dump() + ": x");
        expect_near(Vec3(m[1]), y, 1e-12, given.dump() + ": y");
        expect_near(Vec3(m[2]), z, 1e-12, given.dump() + ": z");
        expect_near(Vec3(m[3]), position, 1e-12, given.dump() + ": position");
    }
    static Json camera_of(const Json& camera) {
        Json file = scene_of({{"type", "quad"}});
        file["camera"].update(camera);
        return file;
    }
    void expect_camera(const Json& camera, const std::string& sensor) const {
        SCOPED_TRACE(camera.dump());
        expect_same_camera(read_tungsten(camera_of(camera)), read(sensor + "<shape type='rectangle'/>"));
    }
    static std::string film(const std::string& filter) {
        return "<film type='hdrfilm'><integer name='width' value='8'/><integer name='height' value='8'/>" + filter + "</film>";
    }
};

// About z, x and y in this order; y turns the other way round.
TEST_F(TungstenScenes, Rotations) {
    expect_columns({{"rotation", {0, 90, 0}}}, {0, 0, 1}, {0, 1, 0}, {-1, 0, 0});
    expect_columns({{"rotation", {90, 0, 0}}}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0});
    expect_columns({{"rotation", {0, 0, 90}}}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 1});
    expect_columns({{"rotation", {90, 90, 0}}}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0});
    expect_columns({{"rotation", {90, 0, 90}}}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0});
    expect_columns({{"rotation", {0, 90, 0}}, {"scale", {2, 3, 4}}, {"position", {5, 6, 7}}}, {0, 0, 2}, {0, 3, 0}, {-4, 0, 0},
                   {5, 6, 7});
    expect_columns({{"scale", 2}}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2});
}

// Axes that are given are made perpendicular, and the others follow.
TEST_F(TungstenScenes, Axes) {
    expect_columns({{"position", {1, 2, 3}}, {"look_at", {1, 2, 9}}, {"up", {0, 1, 0.5}}}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                   {1, 2, 3});
    expect_columns({{"look_at", {5, 0, 0}}}, {0, 0, -1}, {0, 1, 0}, {1, 0, 0});
    expect_columns({{"x_axis", {2, 0, 2}}}, Vec3(1, 0, 1) / std::sqrt(2.0), {0, 1, 0}, Vec3(-1, 0, 1) / std::sqrt(2.0));
    expect_columns({{"y_axis", {0, 0, 2}}, {"x_axis", {1, 0, 1}}}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0});
    expect_columns({{"x_axis", {1, 1, 0}}, {"z_axis", {0, 0, -1}}}, Vec3(1, 1, 0) / std::sqrt(2.0), Vec3(1, -1, 0) / std::sqrt(2.0),
                   {0, 0, -1});
    // Looking along the upwards direction.
    expect_columns({{"look_at", {0, 2, 0}}}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0});
}

TEST_F(TungstenScenes, Matrices) {
    expect_columns({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 0, 1}, {1, 5, 9}, {2, 6, 10}, {3, 7, 11}, {4, 8, 12});
}

// It looks along +z; fov is that from left to right.
TEST_F(TungstenScenes, Cameras) {
    const std::string from_here = "<float name='fov' value='40'/>" + film("<rfilter type='tent'/>");
    expect_camera({{"transform", {{"position", {1, 2, 3}}, {"look_at", {4, 3, 3}}, {"up", {0, 0, 1}}}}},
                  "<sensor type='perspective'>" + from_here + to_world("<lookat origin='1, 2, 3' target='4, 3, 3' up='0, 0, 1'/>") +
                      "</sensor>");
    expect_camera({{"transform", {{"scale", 3}}}}, "<sensor type='perspective'>" + from_here + "</sensor>");
    expect_camera({{"resolution", {16, 4}}},
                  "<sensor type='perspective'><float name='fov' value='40'/><film type='hdrfilm'><integer name='width' "
                  "value='16'/><integer name='height' value='4'/><rfilter type='tent'/></film></sensor>");
    const std::string lens = "<sensor type='thinlens'><float name='aperture_radius' value='0.2'/>" + from_here;
    expect_camera({{"type", "thinlens"}, {"aperture_size", 0.2}, {"focus_distance", 5}},
                  lens + "<float name='focus_distance' value='5'/></sensor>");
    // The focus may be on a primitive.
    Json file = camera_of({{"type", "thinlens"}, {"aperture_size", 0.2}, {"focus_pivot", "ball"}});
    file["primitives"].push_back({{"name", "ball"}, {"type", "quad"}, {"transform", {{"position", {0, 3, 4}}}}});
    expect_same_camera(read_tungsten(file),
                       read(lens + "<float name='focus_distance' value='5'/></sensor><shape type='rectangle'/>"));
    EXPECT_EQ(read_tungsten(camera_of(Json::object()), {{"width", "20"}}).film.height, 20);
}

TEST_F(TungstenScenes, PixelFilters) {
    const auto check = [&](const Json& camera, const std::string& filter) {
        expect_camera(camera, "<sensor type='perspective'><float name='fov' value='40'/>" + film(filter) + "</sensor>");
    };
    check({{"reconstruction_filter", "box"}}, "<rfilter type='box'/>");
    check({{"reconstruction_filter", "tent"}}, "<rfilter type='tent'/>");
    check(Json::object(), "<rfilter type='tent'/>");
    check({{"reconstruction_filter", "gaussian"}}, "<rfilter type='gaussian'><float name='stddev' value='0.5'/></rfilter>");
    check({{"reconstruction_filter", "mitchell_netravali"}}, "<rfilter type='mitchell'/>");
    check({{"reconstruction_filter", "catmull_rom"}}, "<rfilter type='catmullrom'/>");
    check({{"reconstruction_filter", "lanczos"}}, "<rfilter type='lanczos'><integer name='lobes' value='2'/></rfilter>");
    EXPECT_EQ(warnings(read_tungsten(camera_of({{"reconstruction_filter", "dirac"}}))),
              "reconstruction_filter 'dirac', which sees the centres of pixels alone: 'box' is taken\n");
}

// With max_bounces = 1, light is seen that comes straight from what emits.
TEST_F(TungstenScenes, Bounces) {
    Json file = scene_of({{"type", "quad"}});
    EXPECT_EQ(read_tungsten(file).bounces, 63);
    file["integrator"] = {{"type", "path_tracer"}, {"max_bounces", 1}};
    EXPECT_EQ(read_tungsten(file).bounces, 0);
    file["integrator"] = {{"type", "bidirectional_path_tracer"}, {"max_bounces", 6}, {"min_bounces", 2}, {"image_pyramid", true}};
    const SceneParts parts = read_tungsten(file);
    EXPECT_EQ(parts.bounces, 5);
    EXPECT_EQ(warnings(parts), "min_bounces of the integrator is 2: the bounces before that are computed as well\n");
}

TEST_F(TungstenScenes, Lights) {
    const std::string quad = "<shape type='rectangle'>" + to_world("<matrix value='0.5 0 0 0 0 0 1 0 0 0.5 0 0 0 0 0 1'/>") +
                             two_sided("<bsdf type='diffuse'><rgb name='reflectance' value='1'/></bsdf>") + "</shape>";
    Json file = scene_of({{"type", "quad"}});
    const auto with = [&](const Json& light) {
        Json both = file;
        both["primitives"].push_back(light);
        return both;
    };
    expect_same(with({{"type", "point"}, {"transform", {{"position", {1, 2, 3}}}}, {"emission", {1, 2, 3}}}), quad,
                "<emitter type='point'><point name='position' value='1, 2, 3'/><rgb name='intensity' value='1, 2, 3'/></emitter>");
    expect_same(with({{"type", "point"}, {"power", 4 * pi}}), quad,
                "<emitter type='point'><point name='position' value='0, 0, 0'/><rgb name='intensity' value='1'/></emitter>");
    expect_same(with({{"type", "infinite_sphere"}, {"emission", {1, 2, 3}}, {"sample", false}}), quad,
                "<emitter type='constant'><rgb name='radiance' value='1, 2, 3'/></emitter>");
    expect_same(with({{"type", "infinite_sphere"}, {"power", 8 * pi}}), quad,
                "<emitter type='constant'><rgb name='radiance' value='2'/></emitter>");
    // Nothing emits.
    expect_same(with({{"type", "point"}, {"emission", 0}}), quad, surroundings);
    EXPECT_EQ(replaced(with({{"type", "infinite_sphere_cap"}, {"power", 3}})),
              "scene.json#/primitives/1/type: primitive type 'infinite_sphere_cap' is not supported; left out\n");
}

// Its column goes by atan2(z, x), with x in the middle, and its row from +y to −y; Mitsuba's first and last rows are at the poles.
TEST_F(TungstenScenes, LightFromAPicture) {
    constexpr int width = 64, height = 32;
    std::vector<std::uint8_t> texels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const int c : {4 * x, 8 * y, 0}) texels.push_back(static_cast<std::uint8_t>(c));
    write("sky.png", encode_png_of(width, 3, texels));
    for (const double angle : {0.0, 30.0}) {
        const SceneParts parts = read_tungsten(scene_of({{"type", "infinite_sphere"},
                                                         {"emission", {{"type", "bitmap"}, {"file", "sky.png"}, {"scale", 2}}},
                                                         {"transform", {{"rotation", {0, angle, 0}}}}}));
        const auto encoded = [](double value) {
            return value < 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
        };
        for (const double azimuth : {-2.5, -1.0, 0.4, 1.2, 2.8})
            for (const double y : {-0.7, 0.1, 0.8}) {
                const double r = std::sqrt(1.0 - y * y);
                // A rotation by `angle` takes x towards z.
                const double turned = azimuth + angle * pi / 180.0;
                const Vec3 w(r * std::cos(turned), y, r * std::sin(turned));
                const Rgb found = radiance(*parts.lights.environment, w) / 2.0;
                const double column = (azimuth / (2.0 * pi) + 0.5) * width - 0.5, row = std::acos(y) / pi * (height - 1);
                EXPECT_NEAR(encoded(found.r) * 255.0, 4.0 * column, 1.0) << angle << " " << azimuth << " " << y;
                EXPECT_NEAR(encoded(found.g) * 255.0, 8.0 * row, 1.0) << angle << " " << azimuth << " " << y;
            }
    }
}

}  // namespace neumann::tungsten_scenes_test
