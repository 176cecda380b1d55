// What takes the picture: sensors, films, filters, samplers, integrators.
#include "core/reader/convert_scene.h"
#include "core/sensor/sensor.h"
#include "tests/reader/xml_scene_files.h"

#include <numbers>

namespace neumann::xml_sensors_test {

const std::string small_film = "<film type='hdrfilm'><integer name='width' value='1'/><integer name='height' value='1'/></film>";

class XmlSensors : public XmlTest {
protected:
    SceneParts read_sensor(const std::string& inside) const {
        return read_file("<scene version=\"3.0.0\"><sensor type=\"perspective\">\n" + inside + "</sensor></scene>");
    }
    static double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
};

TEST_F(XmlSensors, Camera) {
    const SceneParts parts = read_sensor(
        "<float name='fov' value='30'/><string name='fov_axis' value='smaller'/><float name='near_clip' value='10'/>"
        "<integer name='far_clip' value='2800'/><float name='focus_distance' value='1000'/>"
        "<float name='principal_point_offset_x' value='0.25'/><float name='principal_point_offset_y' value='-0.5'/>");
    EXPECT_DOUBLE_EQ(parts.camera.fov, radians(30.0));
    EXPECT_EQ(parts.camera.fov_axis, FovAxis::smaller);
    EXPECT_EQ(parts.camera.near_clip, 10.0);
    EXPECT_EQ(parts.camera.far_clip, 2800.0);
    EXPECT_EQ(parts.camera.principal_point_offset, Vec2(0.25, -0.5));
}

TEST_F(XmlSensors, FocalLength) {
    for (const char* given : {"<string name='focal_length' value='50mm'/>", ""}) {
        const SceneParts parts = read_sensor(given);
        EXPECT_EQ(parts.camera.fov_axis, FovAxis::diagonal);
        EXPECT_NEAR(parts.camera.fov * 180.0 / std::numbers::pi, 46.7930, 1e-4);  // what a 50 mm lens is known for
    }
}

TEST_F(XmlSensors, OtherSensors) {
    const auto camera = [&](const std::string& type, const std::string& inside) {
        return read_file("<scene version='3.0.0'><sensor type='" + type + "'>" + inside + "</sensor></scene>").camera;
    };
    const SensorOptions lens = camera("thinlens", "<float name='aperture_radius' value='0.1'/><float name='fov' value='30'/>");
    EXPECT_EQ(lens.kind, SensorOptions::Kind::thin_lens);
    EXPECT_EQ(lens.aperture_radius, 0.1);
    EXPECT_EQ(lens.focus_distance, 1e4);  // the far plane
    EXPECT_DOUBLE_EQ(lens.fov, radians(30.0));
    EXPECT_EQ(
        camera("thinlens", "<float name='aperture_radius' value='0.1'/><float name='focus_distance' value='3'/>").focus_distance,
        3.0);
    const SensorOptions flat = camera("orthographic", "<transform name='to_world'><scale x='10' y='10'/></transform>");
    EXPECT_EQ(flat.kind, SensorOptions::Kind::orthographic);
    EXPECT_EQ(flat.to_world[0][0], 10.0);
    EXPECT_EQ(flat.near_clip, 1e-2);
}

TEST_F(XmlSensors, MirroredCamera) {
    const SceneParts parts = read_sensor("<float name='fov' value='9'/><transform name='to_world'><scale x='-1'/></transform>");
    EXPECT_EQ(parts.camera.to_world[0][0], -1.0);
}

TEST_F(XmlSensors, FilmAndSampler) {
    const SceneParts parts = read_sensor(
        "<float name='fov' value='9'/><sampler type='multijitter'><integer name='sample_count' value='64'/>"
        "<integer name='seed' value='3'/></sampler>"
        "<film type='hdrfilm'><integer name='width' value='100'/><integer name='height' value='50'/>"
        "<integer name='crop_offset_x' value='20'/><integer name='crop_offset_y' value='10'/><integer name='crop_width' "
        "value='30'/>"
        "<string name='pixel_format' value='rgba'/><string name='component_format' value='float32'/>"
        "<string name='file_format' value='openexr'/><boolean name='banner' value='FALSE'/><rfilter type='box'/></film>");
    EXPECT_EQ(parts.sampler, SamplerKind::sobol);
    EXPECT_EQ(parts.film.width, 100);
    EXPECT_EQ(parts.film.height, 50);
    EXPECT_EQ(parts.film.crop_x, 20);
    EXPECT_EQ(parts.film.crop_y, 10);
    EXPECT_EQ(parts.film.crop_width, 30);
    EXPECT_EQ(parts.film.crop_height, 40);
    EXPECT_TRUE(std::holds_alternative<BoxFilter>(parts.film.filter));
}

TEST_F(XmlSensors, Samplers) {
    for (const auto& [type, kind] : std::map<std::string, SamplerKind>{{"independent", SamplerKind::independent},
                                                                       {"ldsampler", SamplerKind::sobol},
                                                                       {"orthogonal", SamplerKind::sobol},
                                                                       {"stratified", SamplerKind::sobol}})
        EXPECT_EQ(read_sensor("<float name='fov' value='9'/><sampler type='" + type + "'/>").sampler, kind) << type;
}

TEST_F(XmlSensors, Filters) {
    const auto filter = [&](const std::string& inside) {
        return read_sensor("<float name='fov' value='9'/><film type='hdrfilm'>" + inside + "</film>").film.filter;
    };
    EXPECT_EQ(std::get<TentFilter>(filter("<rfilter type='tent'/>")).radius(), 1.0);
    EXPECT_EQ(std::get<TentFilter>(filter("<rfilter type='tent'><float name='radius' value='2.5'/></rfilter>")).radius(), 2.5);
    EXPECT_EQ(std::get<GaussianFilter>(filter("<rfilter type='gaussian'><float name='stddev' value='1'/></rfilter>")).radius(),
              4.0);
    const auto at = [&](const std::string& inside, double x) { return std::get<SignedFilter>(filter(inside))(x); };
    // Mitchell and Netravali's values at 0 and 1: 1 − B/3 and B/6.
    EXPECT_NEAR(at("<rfilter type='mitchell'/>", 0.0), 8.0 / 9.0, 1e-15);
    EXPECT_NEAR(at("<rfilter type='mitchell'/>", -1.0), 1.0 / 18.0, 1e-15);
    EXPECT_NEAR(at("<rfilter type='mitchell'><float name='B' value='1'/><float name='C' value='0'/></rfilter>", 1.0), 1.0 / 6.0,
                1e-15);
    EXPECT_NEAR(at("<rfilter type='catmullrom'/>", 0.0), 1.0, 1e-15);
    EXPECT_NEAR(at("<rfilter type='catmullrom'/>", 1.5), -0.0625, 1e-15);
    // sinc(3/2) sinc(1/2) = −4 / (3 π²).
    EXPECT_NEAR(at("<rfilter type='lanczos'/>", 1.5), -4.0 / (3.0 * std::numbers::pi * std::numbers::pi), 1e-15);
    EXPECT_EQ(std::get<SignedFilter>(filter("<rfilter type='lanczos'/>")).radius(), 3.0);
    EXPECT_EQ(std::get<SignedFilter>(filter("<rfilter type='lanczos'><integer name='lobes' value='5'/></rfilter>")).radius(), 5.0);
    EXPECT_FALSE(read("").film.sample_border);
    EXPECT_TRUE(read_sensor("<float name='fov' value='9'/><film type='hdrfilm'><boolean name='sample_border' value='true'/>"
                            "<string name='file_format' value='exr'/></film>")
                    .film.sample_border);
}

TEST_F(XmlSensors, MaxDepthCountsOneMoreThanBounces) {
    const auto bounces = [&](const std::string& inside) {
        return read("<integrator type='path'>" + inside + "</integrator>").bounces;
    };
    EXPECT_EQ(bounces("<integer name='max_depth' value='6'/><integer name='rr_depth' value='3'/>"), 5);
    EXPECT_EQ(bounces("<integer name='max_depth' value='1'/><boolean name='hide_emitters' value='false'/>"), 0);
    EXPECT_EQ(bounces("<integer name='max_depth' value='-1'/>"), std::nullopt);
    EXPECT_EQ(bounces(""), std::nullopt);
    for (const char* type : {"ptracer", "volpath", "volpathmis"})
        EXPECT_EQ(read(std::string("<integrator type='") + type + "'><integer name='max_depth' value='3'/></integrator>").bounces,
                  2);
}

// An `aov` has the picture of the integrator inside it; what else it would write is said.
TEST_F(XmlSensors, Channels) {
    const SceneParts parts = read(
        "<integrator type='aov'><string name='aovs' value='dd.y:depth,nn:sh_normal'/><integrator type='path' name='image'>"
        "<integer name='max_depth' value='4'/><boolean name='hide_emitters' value='true'/></integrator></integrator>");
    EXPECT_EQ(parts.bounces, 3);
    EXPECT_TRUE(parts.hide_emitters);
    EXPECT_EQ(
        parts.warnings.counts(),
        (Warnings::Counts{{"integrator 'aov': its channels are not written, only the picture of the integrator inside it", 1}}));
    EXPECT_EQ(
        read("<integrator type='aov'><integrator type='moment'><integrator type='direct'/></integrator></integrator>").bounces, 1);
}

// One ray from the sensor along its z axis, or from `origin` along `direction`, as narrow as a millionth of its length.
TEST_F(XmlSensors, RadianceMeters) {
    const auto ray = [&](const std::string& inside) {
        const SceneParts parts = read_file(
            "<scene version='3.0.0'><sensor type='radiancemeter'>" + inside +
            "<film type='hdrfilm'><integer name='width' value='1'/><integer name='height' value='1'/></film></sensor></scene>");
        EXPECT_EQ(parts.film.width, 1);
        EXPECT_EQ(parts.film.height, 1);
        const Sensor sensor(parts.camera, parts.film);
        const CameraRay middle = sensor.ray(Vec2(0.5)), corner = sensor.ray(Vec2(0.0));
        EXPECT_NEAR(glm::distance(middle.direction, corner.direction), 0.0, 1e-6);
        return middle;
    };
    const CameraRay plain = ray("");
    EXPECT_NEAR(glm::distance(plain.origin, Vec3(0, 0, 0)), 0.0, 2e-6);
    EXPECT_NEAR(glm::distance(plain.direction, Vec3(0, 0, 1)), 0.0, 1e-12);
    for (const CameraRay& same :
         {ray("<point name='origin' x='1' y='2' z='3'/><vector name='direction' x='0' y='-4' z='3'/>"),
          ray("<transform name='to_world'><lookat origin='1, 2, 3' target='1, -6, 9' up='0, 0, 1'/></transform>"),
          ray("<transform name='to_world'><scale x='3' y='2' z='7'/><lookat origin='1, 2, 3' target='1, -2, 6' up='0, 0, "
              "1'/></transform>")}) {
        EXPECT_NEAR(glm::distance(same.origin, Vec3(1, 2, 3)), 0.0, 2e-6);
        EXPECT_NEAR(glm::distance(same.direction, Vec3(0, -0.8, 0.6)), 0.0, 1e-12);
        EXPECT_GE(same.length, 1e11);
    }
}

// A child of a shape, or referred to by it.
TEST_F(XmlSensors, IrradianceMeters) {
    const std::string other = "<shape type='sphere'/>\n",
                      meter = "<sensor type='irradiancemeter' id='m'>" + small_film + "</sensor>";
    for (const std::string& inside : {other + "<shape type='disk'>" + meter + "</shape>",
                                      other + "<shape type='merge'><shape type='disk'>" + meter + "</shape></shape>"}) {
        const SceneParts parts = read_file("<scene version='3.0.0'>" + inside + "</scene>");
        EXPECT_EQ(parts.camera.kind, SensorOptions::Kind::irradiance_meter);
        EXPECT_EQ(parts.camera.shape, 1u);
        EXPECT_EQ(parts.film.width, 1);
    }
    const Scene scene =
        make_scene(read_file("<scene version='3.0.0'>" + other + "<shape type='disk'>" + meter + "</shape></scene>"));
    EXPECT_TRUE(std::holds_alternative<BoxFilter>(scene.film.filter));
}

TEST_F(XmlSensors, DistantSensors) {
    const auto camera = [&](const std::string& inside, const std::string& before = "") {
        return read_file("<scene version='3.0.0'>" + before + "<sensor type='distant'>" + inside + small_film + "</sensor></scene>")
            .camera;
    };
    for (const SensorOptions& options : {camera("<vector name='direction' x='0' y='-8' z='6'/>"),
                                         camera("<transform name='to_world'><scale value='3'/><lookat origin='1, 2, 3' target='1, "
                                                "-2, 6' up='0, 0, 1'/></transform>")}) {
        EXPECT_EQ(options.kind, SensorOptions::Kind::distant);
        EXPECT_NEAR(glm::distance(Vec3(options.to_world[2]), Vec3(0, -0.8, 0.6)), 0.0, 1e-12);
        EXPECT_EQ(options.target.index(), 0u);
    }
    EXPECT_EQ(std::get<Vec3>(camera("<point name='target' x='1' y='2' z='3'/>").target), Vec3(1, 2, 3));
    const std::string ball = "<shape type='sphere' name='target' id='ball'><float name='radius' value='2'/></shape>";
    for (const SensorOptions& options : {camera(ball), camera("<ref id='ball' name='target'/>", ball)})
        EXPECT_EQ(std::get<Sphere>(*std::get<std::shared_ptr<const Shape>>(options.target)).radius, 2.0);
    // A shape that only the sensor has is not in the scene.
    EXPECT_TRUE(
        read_file("<scene version='3.0.0'><sensor type='distant'>" + ball + small_film + "</sensor></scene>").shapes.empty());
}

TEST_F(XmlSensors, Batches) {
    const std::string size = "<integer name='width' value='12'/><integer name='height' value='2'/><rfilter type='box'/>";
    const SceneParts parts = read_file(
        "<scene version='3.0.0'><shape type='cube'/><shape type='disk' id='disk'><sensor type='irradiancemeter'/></shape>"
        "<sensor type='batch'><sensor type='perspective'><float name='fov' value='30'/><film type='hdrfilm'/></sensor>"
        "<ref id='disk'/><sensor type='distant' name='b'/><sensor type='orthographic' name='a'/><film type='hdrfilm'>" +
        size + "</film><sampler type='independent'/></sensor></scene>");
    using Kind = SensorOptions::Kind;
    EXPECT_EQ(parts.camera.kind, Kind::batch);
    std::vector<Kind> kinds;
    for (const SensorOptions& sensor : parts.camera.sensors) kinds.push_back(sensor.kind);
    EXPECT_EQ(kinds, (std::vector{Kind::perspective, Kind::irradiance_meter, Kind::distant, Kind::orthographic}));
    EXPECT_EQ(parts.camera.sensors[1].shape, 1u);
    EXPECT_EQ(parts.film.width, 12);
    EXPECT_EQ(parts.sampler, SamplerKind::independent);
}

// Written as Mitsuba's XML and read again.
TEST_F(XmlSensors, AreConverted) {
    const SceneParts first = read_file(
        "<scene version='3.0.0'><default name='half' value='6'/><shape type='disk' id='disk'><sensor type='irradiancemeter'/>"
        "<emitter type='directionalarea'/></shape><sensor type='batch'><ref id='disk'/><sensor type='distant'>"
        "<shape type='sphere' name='target'/><vector name='direction' x='0' y='1' z='0'/></sensor><film type='hdrfilm'>"
        "<integer name='width' value='$half'/><rfilter type='box'/></film></sensor></scene>");
    write("again.xml", convert_scene(path("scene.xml"), {}, false).xml);
    const SceneParts again = read_scene_parts(path("again.xml"));
    for (const SceneParts* parts : {&first, &again}) {
        ASSERT_EQ(parts->camera.sensors.size(), 2u);
        EXPECT_EQ(parts->camera.sensors[0].kind, SensorOptions::Kind::irradiance_meter);
        EXPECT_EQ(Vec3(parts->camera.sensors[1].to_world[2]), Vec3(0, 1, 0));
        EXPECT_EQ(parts->camera.sensors[1].target.index(), 2u);
        EXPECT_EQ(parts->film.width, 6);
        ASSERT_EQ(parts->lights.area.size(), 1u);
        EXPECT_TRUE(parts->lights.area[0].along_normal);
    }
}

TEST_F(XmlSensors, Integrators) {
    const auto scene = [&](const std::string& integrator) { return read(integrator); };
    const SceneParts direct = scene("<integrator type='direct'><integer name='emitter_samples' value='0'/></integrator>");
    EXPECT_EQ(direct.bounces, 1);
    EXPECT_FALSE(direct.hide_emitters);
    EXPECT_EQ(scene("<integrator type='direct'><integer name='shading_samples' value='4'/></integrator>").bounces, 1);
    EXPECT_TRUE(scene("<integrator type='direct'><boolean name='hide_emitters' value='true'/></integrator>").hide_emitters);
    const SceneParts moment = scene(
        "<integrator type='moment'><integrator type='path' name='first'><integer name='max_depth' value='4'/>"
        "<boolean name='hide_emitters' value='true'/></integrator></integrator>");
    EXPECT_EQ(moment.bounces, 3);
    EXPECT_TRUE(moment.hide_emitters);
    EXPECT_EQ(scene("<integrator type='path'><integer name='samples_per_pass' value='8'/><integer name='block_size' value='32'/>"
                    "<float name='timeout' value='-1'/></integrator>")
                  .bounces,
              std::nullopt);
}

}  // namespace neumann::xml_sensors_test
