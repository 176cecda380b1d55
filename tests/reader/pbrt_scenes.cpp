// Transformations, objects, cameras and films: pbrt files and Mitsuba files that say the same.
#include "tests/reader/pbrt_scene_files.h"

#include <fmt/format.h>

namespace neumann::pbrt_scenes_test {

class PbrtScenes : public PbrtTest {
protected:
    // The camera and the film of a pbrt file against a sensor of Mitsuba.
    void expect_same_sensor(const std::string& options, const std::string& sensor) const {
        SCOPED_TRACE(options);
        const SceneParts a = read_pbrt_file(options + "\nWorldBegin\n"), b = read(sensor);
        expect_same_camera(a, b);
    }
    static std::string film(int width, int height, const std::string& inside = "") {
        return fmt::format("<film type='hdrfilm'><integer name='width' value='{}'/><integer name='height' value='{}'/>{}</film>",
                           width, height, inside);
    }
};

TEST_F(PbrtScenes, Transformations) {
    const std::string sphere = "Shape \"sphere\"";
    const auto in_mitsuba = [](const std::string& t) {
        return with_grey("<shape type='sphere'>" + to_world(t) + "<ref id='grey'/></shape>");
    };
    expect_same("Translate 1 2 3 Scale 2 2 2 Rotate 90 0 0 2\n" + sphere,
                in_mitsuba("<rotate z='1' angle='90'/><scale value='2'/><translate x='1' y='2' z='3'/>"));
    expect_same("Translate 5 5 5 Identity Transform [0 2 0 0 -2 0 0 0 0 0 2 0 1 2 3 1]\n" + sphere,
                in_mitsuba("<matrix value='0 -2 0 1  2 0 0 2  0 0 2 3  0 0 0 1'/>"));
    expect_same("Translate 1 0 0 ConcatTransform [0 2 0 0 -2 0 0 0 0 0 2 0 1 2 3 1]\n" + sphere,
                in_mitsuba("<matrix value='0 -2 0 1  2 0 0 2  0 0 2 3  0 0 0 1'/><translate x='1'/>"));
    expect_same("AttributeBegin Translate 1 0 0 CoordinateSystem \"there\" AttributeEnd\nCoordSysTransform \"there\" " + sphere,
                in_mitsuba("<translate x='1'/>"));
    expect_same("Translate 1 0 0 TransformBegin Translate 1 0 0 TransformEnd " + sphere, in_mitsuba("<translate x='1'/>"));
    expect_same("Translate 1 0 0 CoordSysTransform \"world\" TransformTimes 0 1 ActiveTransform All " + sphere, in_mitsuba(""));
    expect_same_sensor(
        "LookAt 1 2 3 4 6 5 0 1 0 Camera \"perspective\" \"float fov\" 40 Film \"rgb\" \"integer xresolution\" 8 \"integer "
        "yresolution\" 8",
        "<sensor type='perspective'><float name='fov' value='40'/>" +
            to_world("<scale x='-1'/><lookat origin='1, 2, 3' target='4, 6, 5' up='0, 1, 0'/>") + film(8, 8) + "</sensor>");
    // "camera" is where the camera is.
    EXPECT_EQ(
        std::get<Sphere>(
            read_pbrt_file("Translate -1 -2 -3 Camera \"perspective\" WorldBegin CoordSysTransform \"camera\" Shape \"sphere\"")
                .shapes.at(0))
            .center,
        Vec3(1.0, 2.0, 3.0));
}

TEST_F(PbrtScenes, Objects) {
    const std::string group = "<shape type='shapegroup' id='g'><shape type='sphere'>" + to_world("<translate x='1'/>") +
                              "<ref id='grey'/></shape></shape>";
    expect_same(
        "ObjectBegin \"ball\" Translate 1 0 0 Shape \"sphere\" ObjectEnd\n"
        "AttributeBegin Scale 2 2 2 ObjectInstance \"ball\" AttributeEnd\nTranslate 0 5 0 ObjectInstance \"ball\"",
        grey + group + "<shape type='instance'>" + to_world("<scale value='2'/>") + "<ref id='g'/></shape><shape type='instance'>" +
            to_world("<translate y='5'/>") + "<ref id='g'/></shape>");
    EXPECT_TRUE(read_pbrt("ObjectBegin \"ball\" Shape \"sphere\" ObjectEnd").shapes.empty());
    EXPECT_TRUE(read_pbrt("ObjectBegin \"none\" ObjectEnd ObjectInstance \"none\"").shapes.empty());
    EXPECT_EQ(
        warning(read_pbrt("AreaLightSource \"diffuse\" ObjectBegin \"ball\" Shape \"sphere\" ObjectEnd ObjectInstance \"ball\"")),
        "area light in an object: instances do not emit, as in pbrt");
}

TEST_F(PbrtScenes, Cameras) {
    const std::string mirror = to_world("<scale x='-1'/>"),
                      small = "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 4";
    const auto perspective = [&](const std::string& inside) {
        return "<sensor type='perspective'>" + mirror + inside + film(8, 4) + "</sensor>";
    };
    // The angle is that of the shorter side.
    expect_same_sensor(small + " Camera \"perspective\" \"float fov\" 40",
                       perspective("<float name='fov' value='40'/><string name='fov_axis' value='y'/>"));
    // x from −0.5 to 1.5 and y from −0.25 to 0.75, in units of tan 20°: to the right and up.
    const double unit = std::tan(glm::radians(20.0));
    expect_same_sensor(
        small + " Camera \"perspective\" \"float fov\" 40 \"float screenwindow\" [-0.5 1.5 -0.25 0.75]",
        perspective(fmt::format("<float name='fov' value='{}'/><float name='principal_point_offset_x' value='-0.25'/><float "
                                "name='principal_point_offset_y' value='0.25'/>",
                                2.0 * glm::degrees(std::atan(unit)))));
    const Sensor shifted = [&] {
        const SceneParts parts = read_pbrt_file(
            small + " Camera \"perspective\" \"float fov\" 40 \"float screenwindow\" [-0.5 1.5 -0.25 0.75] WorldBegin");
        return Sensor(parts.camera, parts.film);
    }();
    // Here pbrt's +x is to the right, its +y up, and it looks along +z.
    expect_near(shifted.ray(Vec2(0.0, 0.0)).direction, glm::normalize(Vec3(-0.5 * unit, 0.75 * unit, 1.0)), 1e-12,
                "upper left corner");
    expect_near(shifted.ray(Vec2(8.0, 4.0)).direction, glm::normalize(Vec3(1.5 * unit, -0.25 * unit, 1.0)), 1e-12,
                "lower right corner");
    expect_same_sensor(
        small + " Scale 2 2 2 Camera \"perspective\" \"float lensradius\" 0.5 \"float focaldistance\" 6",
        "<sensor type='thinlens'>" + mirror +
            "<float name='fov' value='90'/><string name='fov_axis' value='y'/><float name='aperture_radius' value='0.25'/>"
            "<float name='focus_distance' value='3'/>" +
            film(8, 4) + "</sensor>");
    expect_same_sensor(small + " Translate 0 0 -5 Camera \"orthographic\" \"float screenwindow\" [0 8 -1 3]",
                       "<sensor type='orthographic'>" + to_world("<scale x='-4' y='4'/><translate x='4' y='1' z='5'/>") +
                           film(8, 4) + "</sensor>");
}

TEST_F(PbrtScenes, Films) {
    const auto sensor = [&](const std::string& inside) {
        return "<sensor type='perspective'><float name='fov' value='90'/>" + to_world("<scale x='-1'/>") + film(8, 8, inside) +
               "</sensor>";
    };
    const std::string size = "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 ";
    const std::string crop =
        "<integer name='crop_offset_x' value='2'/><integer name='crop_width' value='4'/><integer name='crop_offset_y' "
        "value='1'/><integer "
        "name='crop_height' value='7'/>";
    expect_same_sensor(size + "\"float cropwindow\" [0.25 0.75 0.1 1]", sensor(crop));
    expect_same_sensor(size + "\"integer pixelbounds\" [2 6 1 8]", sensor(crop));
    const auto filter = [&](const std::string& type, const std::string& inside) {
        return sensor("<rfilter type='" + type + "'>" + inside + "</rfilter>");
    };
    expect_same_sensor(size, filter("gaussian", "<float name='stddev' value='0.5'/>"));
    expect_same_sensor(size + "PixelFilter \"gaussian\" \"float sigma\" 0.7 \"float xradius\" 3 \"float yradius\" 3",
                       filter("gaussian", "<float name='stddev' value='0.7'/>"));
    expect_same_sensor(size + "PixelFilter \"box\"", filter("box", ""));
    expect_same_sensor(size + "PixelFilter \"triangle\"", filter("tent", "<float name='radius' value='2'/>"));
    expect_same_sensor(size + "PixelFilter \"mitchell\" \"float B\" 0.5", filter("mitchell", "<float name='B' value='0.5'/>"));
    expect_same_sensor(size + "PixelFilter \"sinc\" \"float xradius\" 3 \"float yradius\" 3",
                       filter("lanczos", "<integer name='lobes' value='3'/>"));
    const auto warnings_of = [&](const std::string& options) { return warning(read_pbrt_file(options + " WorldBegin")); };
    EXPECT_EQ(warnings_of("PixelFilter \"box\" \"float xradius\" 1 \"float yradius\" 1"),
              "pixel filter 'box' of radius 1: its radius is 0.5 here");
    EXPECT_EQ(warnings_of("PixelFilter \"triangle\" \"float xradius\" 1"),
              "pixel filter with xradius and yradius that differ: their mean is taken");
    EXPECT_EQ(warnings_of("PixelFilter \"sinc\""), "pixel filter 'sinc' of radius 4: its radius is 3 here");
    EXPECT_EQ(warnings_of("Film \"rgb\" \"string sensor\" \"canon_eos_5d_mkiv\""),
              "film with the sensor of a camera: colours are those of the sensor 'cie1931'");
    EXPECT_EQ(warnings_of("Film \"rgb\" \"float whitebalance\" 5000"), "whitebalance of the film is left out");
    EXPECT_EQ(warnings_of("Film \"rgb\" \"float maxcomponentvalue\" 10"),
              "maxcomponentvalue of the film is left out: no sample is cut off");
    EXPECT_EQ(warnings_of("Integrator \"path\" \"bool regularize\" true"),
              "regularize of the integrator is left out: no material becomes rougher along a path");
    EXPECT_EQ(read_pbrt_file("Integrator \"path\" \"integer maxdepth\" 3 Sampler \"independent\" WorldBegin").bounces, 3);
    EXPECT_EQ(read_pbrt_file("Integrator \"path\" Sampler \"independent\" WorldBegin").sampler, SamplerKind::independent);
}

// A room with a lamp, a ball of glass and two of gold, told twice.
TEST_F(PbrtScenes, ARoomIsTheSameRoom) {
    const SceneParts a = read_pbrt_file(R"(
Integrator "volpath" "integer maxdepth" 4
LookAt 0 1 -3.4  0 1 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 160 "integer yresolution" 120
PixelFilter "box"
Sampler "independent" "integer pixelsamples" 64
WorldBegin
MakeNamedMaterial "white" "string type" "diffuse" "rgb reflectance" [ .7 .7 .7 ]
NamedMaterial "white"
Shape "bilinearmesh" "point3 P" [ -1 0 -1 1 0 -1 -1 0 1 1 0 1 ]
AttributeBegin
  Material "diffuse" "rgb reflectance" [ .7 .1 .1 ]
  Translate -1 0 -1 Rotate -90 0 1 0 Scale 2 2 1
  Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 1 1 0 0 1 0 ] "integer indices" [ 0 1 2 0 2 3 ]
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 8 8 4 ] "float scale" 0.5
  Translate 0 1.98 0 Rotate 90 1 0 0
  Shape "disk" "float radius" .35
AttributeEnd
AttributeBegin
  Material "dielectric"
  Translate .45 .3 -.2 Shape "sphere" "float radius" .3
AttributeEnd
ObjectBegin "ball"
  Material "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k" "float roughness" .04
  Shape "sphere" "float radius" .2
ObjectEnd
AttributeBegin Translate -.5 .2 0 ObjectInstance "ball" AttributeEnd
AttributeBegin Translate -.5 .5 .5 Scale .5 .5 .5 ObjectInstance "ball" AttributeEnd
)");
    write("floor.obj", "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 1 2 3 4\n");
    write("wall.obj", "v -1 0 -1\nv -1 0 1\nv -1 2 1\nv -1 2 -1\nf 1 2 3 4\n");
    const SceneParts b = read(R"(
<integrator type="path"><integer name="max_depth" value="5"/></integrator>
<sensor type="perspective">
  <transform name="to_world"><scale x="-1"/><lookat origin="0, 1, -3.4" target="0, 1, 0" up="0, 1, 0"/></transform>
  <float name="fov" value="40"/><string name="fov_axis" value="y"/>
  <film type="hdrfilm"><integer name="width" value="160"/><integer name="height" value="120"/><rfilter type="box"/></film>
  <sampler type="independent"><integer name="sample_count" value="64"/></sampler>
</sensor>
<bsdf type="twosided" id="gold"><bsdf type="roughconductor"><string name="material" value="Au"/>
  <string name="distribution" value="ggx"/><float name="alpha" value="0.2"/></bsdf></bsdf>
<bsdf type="twosided" id="white"><bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.7, 0.7"/></bsdf></bsdf>
<shape type="shapegroup" id="ball"><shape type="sphere"><float name="radius" value="0.2"/><ref id="gold"/></shape></shape>
<shape type="instance"><ref id="ball"/><transform name="to_world"><translate x="-0.5" y="0.2"/></transform></shape>
<shape type="instance"><ref id="ball"/>
  <transform name="to_world"><scale value="0.5"/><translate x="-0.5" y="0.5" z="0.5"/></transform></shape>
<shape type="obj"><string name="filename" value="floor.obj"/><boolean name="face_normals" value="true"/><ref id="white"/></shape>
<shape type="obj"><string name="filename" value="wall.obj"/><boolean name="face_normals" value="true"/>
  <bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.1, 0.1"/></bsdf></bsdf></shape>
<shape type="disk">
  <transform name="to_world"><scale x="0.35" y="0.35"/><rotate x="1" angle="90"/><translate y="1.98"/></transform>
  <ref id="white"/><emitter type="area"><rgb name="radiance" value="4, 4, 2"/></emitter></shape>
<shape type="sphere"><float name="radius" value="0.3"/><point name="center" x="0.45" y="0.3" z="-0.2"/>
  <bsdf type="dielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf></shape>
)");
    expect_same(a, b);
    EXPECT_EQ(a.sampler, b.sampler);
}

}  // namespace neumann::pbrt_scenes_test
