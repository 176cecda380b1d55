// What is wrong with objects and their parameters.
#include "core/image/colour/metals.h"
#include "tests/reader/xml_scene_files.h"

namespace neumann::xml_value_errors_test {

class XmlValueErrors : public XmlTest {
protected:
    std::string diffuse_error(const std::string& parameter) const {
        return error("<bsdf type=\"diffuse\">\n" + parameter + "</bsdf>");
    }
    std::string sensor_error(const std::string& inside) const {
        return file_error("<scene version=\"3.0.0\"><sensor type=\"perspective\">\n" + inside + "</sensor></scene>");
    }
    std::string film_error(const std::string& inside) const {
        return sensor_error("<float name='fov' value='40'/><film type='hdrfilm'>\n" + inside + "</film>");
    }
    std::string transform_error(const std::string& inside) const {
        return error("<shape type='cube'><transform name='to_world'>\n" + inside + "</transform></shape>");
    }
};

TEST_F(XmlValueErrors, UnknownTypes) {
    EXPECT_EQ(error("<bsdf type=\"clay\"/>"),
              "scene.xml:2:7: bsdf type 'clay' is not supported; allowed: blendbsdf, bumpmap, coating, conductor, dielectric, "
              "diffuse, mask, "
              "mixturebsdf, normalmap, null, phong, plastic, principled, principledthin, retroreflector, roughconductor, "
              "roughdielectric, roughplastic, thindielectric, twosided, ward");
    EXPECT_EQ(error("<emitter type=\"glow\"/>"),
              "scene.xml:2:10: emitter type 'glow' is not supported; allowed: area, constant, directional, "
              "directionalarea, envmap, point, projector, spot, sunsky");
    EXPECT_EQ(error("<integrator type=\"gather\"/>"),
              "scene.xml:2:13: integrator type 'gather' is not supported; allowed: aov, direct, moment, path, ptracer, volpath, "
              "volpathmis");
    EXPECT_EQ(
        error("<shape type=\"teapot\"/>"),
        "scene.xml:2:8: shape type 'teapot' is not supported; allowed: "
        "bsplinecurve, cube, cylinder, disk, instance, linearcurve, merge, obj, ply, rectangle, serialized, shapegroup, sphere");
    EXPECT_EQ(error("<sampler type=\"halton\"/>"),
              "scene.xml:2:10: sampler type 'halton' is not supported; allowed: independent, "
              "ldsampler, multijitter, orthogonal, stratified");
    EXPECT_EQ(error("<film type=\"roll\"/>"), "scene.xml:2:7: film type 'roll' is not supported; allowed: hdrfilm");
    EXPECT_EQ(error("<rfilter type=\"sinc\"/>"),
              "scene.xml:2:10: rfilter type 'sinc' is not supported; allowed: box, catmullrom, gaussian, lanczos, mitchell, tent");
    EXPECT_EQ(file_error("<scene version=\"3.0.0\"><sensor type=\"fisheye\"/></scene>"),
              "scene.xml:1:32: sensor type 'fisheye' is not supported; allowed: batch, distant, irradiancemeter, orthographic, "
              "perspective, radiancemeter, thinlens");
}

TEST_F(XmlValueErrors, UnknownParameters) {
    EXPECT_EQ(
        diffuse_error("<rgb name=\"reflectence\" value=\"0.5\"/>"),
        "scene.xml:3:6: unknown parameter 'reflectence' of bsdf 'diffuse'; allowed: reflectance; did you mean 'reflectance'?");
    EXPECT_EQ(error("<bsdf type=\"twosided\"><bsdf type=\"diffuse\"/><float name=\"alpha\" value=\"1\"/></bsdf>"),
              "scene.xml:2:52: unknown parameter 'alpha' of bsdf 'twosided'; it has none");
    EXPECT_EQ(error("<shape type=\"sphere\"><float name=\"radios\" value=\"1\"/></shape>"),
              "scene.xml:2:29: unknown parameter 'radios' of shape 'sphere'; allowed: flip_normals, to_world, center, radius; did "
              "you mean 'radius'?");
    EXPECT_EQ(error("<shape type=\"cube\"><float name=\"radius\" value=\"1\"/></shape>"),
              "scene.xml:2:27: unknown parameter 'radius' of shape 'cube'; allowed: flip_normals, to_world");
    EXPECT_EQ(error("<rfilter type=\"box\"><float name=\"radius\" value=\"1\"/></rfilter>"),
              "scene.xml:2:28: unknown parameter 'radius' of rfilter 'box'; it has none");
    EXPECT_EQ(error("<integrator type=\"path\"><integer name=\"maxdepth\" value=\"1\"/></integrator>"),
              "scene.xml:2:34: unknown parameter 'maxdepth' of integrator 'path'; allowed: max_depth, rr_depth, hide_emitters, "
              "block_size, samples_per_pass, timeout; did you mean 'max_depth'?");
}

TEST_F(XmlValueErrors, NestedWhereItDoesNotBelong) {
    EXPECT_EQ(error("<shape type=\"sphere\"><film type=\"hdrfilm\"/></shape>"),
              "scene.xml:2:22: unexpected <film> in shape 'sphere'; allowed: bsdf, emitter, sensor");
    EXPECT_EQ(error("<bsdf type=\"diffuse\" id=\"a\"/>\n<bsdf type=\"diffuse\"><ref name=\"reflectance\" id=\"a\"/></bsdf>"),
              "scene.xml:3:22: unexpected reference to a <bsdf> in bsdf 'diffuse'; nothing is nested in it");
    EXPECT_EQ(error("<shape type=\"sphere\"><bsdf type=\"diffuse\"/><bsdf type=\"diffuse\"/></shape>"),
              "scene.xml:2:44: shape 'sphere' has more than one <bsdf>");
    EXPECT_EQ(error("<bsdf type='twosided'><bsdf type='diffuse'/><bsdf type='diffuse'/><bsdf type='diffuse'/></bsdf>"),
              "scene.xml:2:67: bsdf 'twosided' has more than two <bsdf>");
}

TEST_F(XmlValueErrors, WrongTypes) {
    EXPECT_EQ(sensor_error("<string name=\"fov\" value=\"40\"/>"),
              "scene.xml:2:1: parameter 'fov' of sensor 'perspective' is a string, expected float or integer");
    EXPECT_EQ(diffuse_error("<boolean name=\"reflectance\" value=\"true\"/>"),
              "scene.xml:3:1: parameter 'reflectance' of bsdf 'diffuse' is a boolean, expected rgb, spectrum, float or integer");
    EXPECT_EQ(film_error("<float name=\"width\" value=\"10\"/>"),
              "scene.xml:3:1: parameter 'width' of film 'hdrfilm' is a float, expected integer");
    EXPECT_EQ(error("<shape type='sphere'>\n<rgb name='to_world' value='1'/></shape>"),
              "scene.xml:3:1: parameter 'to_world' of shape 'sphere' is an rgb, expected transform");
    EXPECT_EQ(error("<shape type='sphere'>\n<integer name='center' value='1'/></shape>"),
              "scene.xml:3:1: parameter 'center' of shape 'sphere' is an integer, expected point or vector");
}

TEST_F(XmlValueErrors, DuplicateParameter) {
    EXPECT_EQ(diffuse_error("<rgb name=\"reflectance\" value=\"0.5\"/>\n<float name=\"reflectance\" value=\"0.5\"/>"),
              "scene.xml:4:8: parameter 'reflectance' of bsdf 'diffuse' is given twice, first at scene.xml:3:1");
}

TEST_F(XmlValueErrors, MissingParameter) {
    EXPECT_EQ(error("<emitter type=\"area\"/>"),
              "scene.xml:2:1: emitter 'area' lacks the parameter 'radiance', expected rgb, spectrum, float or integer");
    EXPECT_EQ(error("<shape type=\"obj\"/>"), "scene.xml:2:1: shape 'obj' lacks the parameter 'filename', expected string");
    EXPECT_EQ(file_error("<scene version='3.0.0'><sensor type='thinlens'/></scene>"),
              "scene.xml:1:24: sensor 'thinlens' lacks the parameter 'aperture_radius', expected float or integer");
    EXPECT_EQ(error("<bsdf type=\"twosided\"/>"), "scene.xml:2:1: bsdf 'twosided' has no <bsdf> inside, expected one or two");
}

TEST_F(XmlValueErrors, Numbers) {
    EXPECT_EQ(diffuse_error("<float name=\"reflectance\" value=\"0.5x\"/>"), "scene.xml:3:27: '0.5x' is not a number");
    EXPECT_EQ(diffuse_error("<float name=\"reflectance\" value=\"\"/>"), "scene.xml:3:27: '' is not a number");
    EXPECT_EQ(diffuse_error("<float name=\"reflectance\" value=\"0.5 0.5\"/>"), "scene.xml:3:27: '0.5 0.5' is not a number");
    EXPECT_EQ(diffuse_error("<float name=\"reflectance\" value=\"+-1\"/>"), "scene.xml:3:27: '+-1' is not a number");
    EXPECT_EQ(diffuse_error("<rgb name=\"reflectance\" value=\"nan\"/>"), "scene.xml:3:25: 'nan' is not a finite number");
    EXPECT_EQ(diffuse_error("<rgb name=\"reflectance\" value=\"1, inf, 1\"/>"), "scene.xml:3:25: 'inf' is not a finite number");
    EXPECT_EQ(diffuse_error("<rgb name=\"reflectance\" value=\"1e999\"/>"),
              "scene.xml:3:25: '1e999' is outside the range of double precision");
    EXPECT_EQ(diffuse_error("<rgb name=\"reflectance\" value=\"1, 1\"/>"), "scene.xml:3:25: '1, 1' has 2 numbers, expected 1 or 3");
    EXPECT_EQ(film_error("<integer name=\"width\" value=\"1.5\"/>"), "scene.xml:3:23: '1.5' is not an integer");
    EXPECT_EQ(film_error("<integer name=\"width\" value=\"99999999999999999999\"/>"),
              "scene.xml:3:23: '99999999999999999999' is outside the range of 64-bit integers");
    EXPECT_EQ(film_error("<boolean name=\"banner\" value=\"yes\"/>"),
              "scene.xml:3:24: 'yes' is not a boolean, expected true or false");
    EXPECT_EQ(error("<shape type='sphere'>\n<point name='center' x='1' y='2'/></shape>"),
              "scene.xml:3:1: <point> lacks the attribute 'z'");
}

TEST_F(XmlValueErrors, Colours) {
    EXPECT_EQ(diffuse_error("<rgb name=\"reflectance\" value=\"0.1, -0.2, 0.3\"/>"),
              "scene.xml:3:25: reflectance is negative: '0.1, -0.2, 0.3'");
    EXPECT_EQ(diffuse_error("<spectrum name=\"reflectance\" value=\"400:0.1, 500:-0.1\"/>"),
              "scene.xml:3:30: reflectance is negative at 500 nm: -0.1");
    EXPECT_EQ(error("<emitter type=\"area\"><float name=\"radiance\" value=\"-1\"/></emitter>"),
              "scene.xml:2:45: radiance is negative: '-1'");
    EXPECT_EQ(diffuse_error("<rgb name=\"reflectance\" value=\"#12345g\"/>"),
              "scene.xml:3:25: '#12345g' is not a colour, expected #rrggbb");
    EXPECT_EQ(diffuse_error("<spectrum name=\"reflectance\" value=\"400:0.1, 0.2\"/>"),
              "scene.xml:3:30: '0.2' is not a pair wavelength:value");
    EXPECT_EQ(diffuse_error("<spectrum name=\"reflectance\" value=\"400:0.1\"/>"),
              "scene.xml:3:30: found 1 of the at least 2 pairs wavelength:value of a spectrum");
    EXPECT_EQ(diffuse_error("<spectrum name=\"reflectance\" value=\"500:0.1 400:0.2\"/>"),
              "scene.xml:3:30: the wavelength 400 follows 500, expected increasing ones");
    EXPECT_EQ(diffuse_error("<spectrum name=\"reflectance\" value=\"400: 0.1\"/>"), "scene.xml:3:30: '' is not a number");
}

TEST_F(XmlValueErrors, Sensors) {
    EXPECT_EQ(file_error("<scene version=\"3.0.0\">\n</scene>"), "scene.xml:1:1: the scene has no <sensor>, expected one");
    EXPECT_EQ(error("<sensor type=\"perspective\"/>"),
              "scene.xml:3:1: a second <sensor>, expected only one; the first is at scene.xml:2:1");
    EXPECT_EQ(error("<integrator type=\"path\"/>\n<integrator type=\"path\"/>"),
              "scene.xml:3:1: a second <integrator>, expected only one; the first is at scene.xml:2:1");
    EXPECT_EQ(sensor_error("<float name='fov' value='180'/>"),
              "scene.xml:2:19: fov is 180, expected more than 0 and less than 180 degrees");
    EXPECT_EQ(sensor_error("<float name='fov' value='0'/>"),
              "scene.xml:2:19: fov is 0, expected more than 0 and less than 180 degrees");
    EXPECT_EQ(sensor_error("<string name='focal_length' value='50cm'/>"),
              "scene.xml:2:29: focal_length is '50cm', expected a positive number and mm, such as 50mm");
    EXPECT_EQ(sensor_error("<float name='fov' value='9'/><string name='focal_length' value='50mm'/>"),
              "scene.xml:2:58: both fov and focal_length are given, expected one of them");
    EXPECT_EQ(sensor_error("<float name='fov' value='9'/><string name='fov_axis' value='z'/>"),
              "scene.xml:2:54: fov_axis is 'z'; allowed: x, y, diagonal, smaller, larger");
    EXPECT_EQ(sensor_error("<float name='fov' value='9'/><float name='near_clip' value='0'/>"),
              "scene.xml:2:54: near_clip is 0, expected more than 0");
    EXPECT_EQ(sensor_error("<float name='fov' value='9'/><float name='far_clip' value='0.01'/>"),
              "scene.xml:2:53: far_clip is 0.01, expected more than near_clip, 0.01");
    EXPECT_EQ(sensor_error("<float name='fov' value='9'/><transform name='to_world'><scale value='1.001'/></transform>"),
              "scene.xml:2:30: to_world of sensor 'perspective' scales or shears, expected rotations and translations");
    EXPECT_EQ(
        file_error("<scene version='3.0.0'><sensor type='thinlens'><float name='aperture_radius' value='-1'/></sensor></scene>"),
        "scene.xml:1:78: aperture_radius is -1, expected at least 0");
    EXPECT_EQ(file_error("<scene version='3.0.0'><sensor type='thinlens'><float name='aperture_radius' value='1'/>"
                         "<float name='focus_distance' value='0'/></sensor></scene>"),
              "scene.xml:1:118: focus_distance is 0, expected more than 0");
    EXPECT_EQ(
        file_error("<scene version='3.0.0'><sensor type='orthographic'><float name='fov' value='9'/></sensor></scene>"),
        "scene.xml:1:59: unknown parameter 'fov' of sensor 'orthographic'; allowed: to_world, near_clip, far_clip, focus_distance");
    EXPECT_EQ(sensor_error("<float name='fov' value='9'/><transform name='to_world'><scale z='0'/></transform>"),
              "scene.xml:2:30: to_world of sensor 'perspective' has no inverse");
}

TEST_F(XmlValueErrors, Films) {
    EXPECT_EQ(film_error("<integer name='width' value='0'/>"), "scene.xml:3:23: film width is 0, expected at least 1");
    EXPECT_EQ(film_error("<integer name='height' value='-5'/>"), "scene.xml:3:24: film height is -5, expected at least 1");
    EXPECT_EQ(film_error("<integer name='width' value='65537'/>"), "scene.xml:3:23: film width is 65537, expected at most 65536");
    EXPECT_EQ(film_error("<integer name='crop_offset_x' value='768'/>"),
              "scene.xml:3:31: film crop_offset_x is 768, expected at least 0 and less than the width, 768");
    EXPECT_EQ(film_error("<integer name='crop_offset_y' value='500'/><integer name='crop_height' value='77'/>"),
              "scene.xml:3:72: film crop_height is 77, but only 76 pixels are left after the offset");
    EXPECT_EQ(film_error("<string name='pixel_format' value='xyz'/>"), "scene.xml:3:29: pixel_format is 'xyz'; allowed: rgb, rgba");
    EXPECT_EQ(film_error("<string name='file_format' value='rgbe'/>"),
              "scene.xml:3:28: file_format is 'rgbe'; allowed: exr, openexr");
    EXPECT_EQ(film_error("<rfilter type='gaussian'><float name='stddev' value='0'/></rfilter>"),
              "scene.xml:3:47: stddev is 0, expected more than 0");
    EXPECT_EQ(film_error("<rfilter type='tent'><float name='radius' value='-1'/></rfilter>"),
              "scene.xml:3:43: radius is -1, expected more than 0");
    EXPECT_EQ(film_error("<rfilter type='mitchell'><float name='B' value='1.5'/></rfilter>"),
              "scene.xml:3:42: B is 1.5, expected from 0 to 1");
    EXPECT_EQ(film_error("<rfilter type='mitchell'><float name='A' value='0'/></rfilter>"),
              "scene.xml:3:33: unknown parameter 'A' of rfilter 'mitchell'; allowed: B, C");
    EXPECT_EQ(film_error("<rfilter type='lanczos'><integer name='lobes' value='0'/></rfilter>"),
              "scene.xml:3:47: lobes is 0, expected from 1 to 64");
}

TEST_F(XmlValueErrors, IntegratorsAndSamplers) {
    EXPECT_EQ(error("<integrator type='path'><integer name='max_depth' value='0'/></integrator>"),
              "scene.xml:2:51: max_depth is 0, expected -1 or at least 1");
    EXPECT_EQ(error("<integrator type='direct'><integer name='max_depth' value='2'/></integrator>"),
              "scene.xml:2:36: unknown parameter 'max_depth' of integrator 'direct'; allowed: shading_samples, emitter_samples, "
              "bsdf_samples, hide_emitters, block_size, samples_per_pass, timeout");
    EXPECT_EQ(error("<integrator type='direct'>\n<integer name='shading_samples' value='2'/><integer name='bsdf_samples' "
                    "value='2'/></integrator>"),
              "scene.xml:3:33: both shading_samples and bsdf_samples are given, expected one of them");
    EXPECT_EQ(error("<integrator type='direct'>\n<integer name='emitter_samples' value='-1'/></integrator>"),
              "scene.xml:3:33: emitter_samples is -1, expected at least 0");
    EXPECT_EQ(error("<integrator type='direct'>\n<integer name='emitter_samples' value='0'/><integer name='bsdf_samples' "
                    "value='0'/></integrator>"),
              "scene.xml:3:33: integrator 'direct' takes no samples of emitters nor of bsdfs, expected at least 1");
    EXPECT_EQ(error("<integrator type='moment'/>"), "scene.xml:2:1: integrator 'moment' has no <integrator> inside, expected one");
    EXPECT_EQ(error("<integrator type='moment'><integrator type='moment'/></integrator>"),
              "scene.xml:2:1: integrator 'moment' stands inside another one");
    EXPECT_EQ(error("<integrator type='moment'><integrator type='bdpt'/></integrator>"),
              "scene.xml:2:39: integrator type 'bdpt' is not supported: 'path' has the same picture");
    EXPECT_EQ(error("<integrator type='aov'/>"), "scene.xml:2:1: integrator 'aov' has no <integrator> inside, expected one");
    EXPECT_EQ(error("<integrator type='aov'><integrator type='aov'/></integrator>"),
              "scene.xml:2:1: integrator 'aov' stands inside another one");
    EXPECT_EQ(error("<integrator type='moment'><integrator type='aov'><integrator type='path'/></integrator></integrator>"),
              "scene.xml:2:1: integrator 'aov' stands inside a 'moment', expected it around that");
    EXPECT_EQ(error("<integrator type='aov'><integrator type='path'/><integrator type='direct'/></integrator>"),
              "scene.xml:2:49: integrator 'aov' has more than one <integrator>");
    EXPECT_EQ(error("<sampler type='independent'><integer name='sample_count' value='0'/></sampler>"),
              "scene.xml:2:58: sample_count is 0, expected at least 1");
}

TEST_F(XmlValueErrors, Transforms) {
    EXPECT_EQ(transform_error("<rotate angle='90'/>"), "scene.xml:3:1: the axis of <rotate> is zero");
    EXPECT_EQ(transform_error("<rotate x='1'/>"), "scene.xml:3:1: <rotate> lacks the attribute 'angle'");
    EXPECT_EQ(transform_error("<translate value='1 2'/>"), "scene.xml:3:12: '1 2' has 2 numbers, expected 1 or 3");
    EXPECT_EQ(transform_error("<translate value='1' x='2'/>"),
              "scene.xml:3:12: <translate> has both 'value' and x, y or z, expected one of them");
    EXPECT_EQ(transform_error("<matrix value='1 2 3'/>"), "scene.xml:3:9: <matrix> has 3 numbers, expected 9 or 16");
    EXPECT_EQ(transform_error("<matrix value='1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0'/>"),
              "scene.xml:3:9: the last row of <matrix> is not 0 0 0 1");
    EXPECT_EQ(transform_error("<lookat origin='1 2 3' target='1 2 3'/>"),
              "scene.xml:3:1: origin and target of <lookat> are the same point");
    EXPECT_EQ(transform_error("<lookat origin='0 0 0' target='0 5 0' up='0 1 0'/>"),
              "scene.xml:3:39: up of <lookat> points along the view");
    EXPECT_EQ(transform_error("<lookat origin='0 0' target='0 5 0'/>"), "scene.xml:3:9: '0 0' has 2 numbers, expected 3");
    EXPECT_EQ(transform_error("<scale value='0'/>"), "scene.xml:2:20: to_world of shape 'cube' has no inverse");
}

TEST_F(XmlValueErrors, Spheres) {
    EXPECT_EQ(
        error("<shape type='sphere'>\n<transform name='to_world'><scale x='2'/></transform></shape>"),
        "scene.xml:3:1: to_world of shape 'sphere' makes it an ellipsoid, expected a uniform scale, rotations and translations");
    EXPECT_EQ(error("<shape type='sphere'>\n<float name='radius' value='-1'/></shape>"),
              "scene.xml:3:22: radius is -1, expected more than 0");
}

TEST_F(XmlValueErrors, Cylinders) {
    const std::string oblique =
        "to_world of shape 'cylinder' makes it elliptic or oblique, expected the same scale all around the axis, rotations and "
        "translations";
    EXPECT_EQ(error("<shape type='cylinder'>\n<transform name='to_world'><scale x='2'/></transform></shape>"),
              "scene.xml:3:1: " + oblique);
    EXPECT_EQ(
        error("<shape type='cylinder'>\n<transform name='to_world'><matrix value='1 0 0.5 0 1 0 0 0 1'/></transform></shape>"),
        "scene.xml:3:1: " + oblique);
    EXPECT_EQ(error("<shape type='cylinder'>\n<float name='radius' value='0'/></shape>"),
              "scene.xml:3:22: radius is 0, expected more than 0");
    EXPECT_EQ(error("<shape type='cylinder'>\n<point name='p1' x='0' y='0' z='0'/></shape>"),
              "scene.xml:3:1: p0 and p1 of shape 'cylinder' are the same point");
    EXPECT_EQ(error("<shape type='cylinder'>\n<float name='p0' value='1'/></shape>"),
              "scene.xml:3:1: parameter 'p0' of shape 'cylinder' is a float, expected point or vector");
    EXPECT_EQ(error("<shape type='cylinder'>\n<float name='height' value='1'/></shape>"),
              "scene.xml:3:8: unknown parameter 'height' of shape 'cylinder'; allowed: flip_normals, to_world, p0, p1, radius");
}

TEST_F(XmlValueErrors, Meshes) {
    EXPECT_EQ(error("<shape type='obj'><string name='filename' value='none.obj'/></shape>"),
              "scene.xml:2:43: there is no file 'none.obj'; looked in: .");
    write("bad.obj", "v 0 0 zero\n");
    EXPECT_EQ(error("<shape type='obj'><string name='filename' value='bad.obj'/></shape>").substr(0, 12), "bad.obj:1:7:");
}

TEST_F(XmlValueErrors, Bsdfs) {
    EXPECT_EQ(error("<bsdf type='twosided'><bsdf type='twosided'><bsdf type='diffuse'/></bsdf></bsdf>"),
              "scene.xml:2:1: bsdf 'twosided' stands inside another one");
    EXPECT_EQ(error("<bsdf type='twosided' id='a'><ref id='a'/></bsdf>"),
              "scene.xml:2:1: bsdf 'twosided' stands inside another one");
}

TEST_F(XmlValueErrors, Conductors) {
    const std::string unknown = error("<bsdf type=\"conductor\">\n<string name=\"material\" value=\"Unobtainium\"/></bsdf>");
    std::string names = "none";
    for (const Metal& metal : metals()) names += ", " + std::string(metal.name);
    EXPECT_EQ(unknown, "scene.xml:3:25: material 'Unobtainium' of bsdf 'conductor' is unknown; allowed: " + names);
    EXPECT_EQ(error("<bsdf type=\"conductor\">\n<string name=\"material\" value=\"Au\"/><float name=\"k\" value=\"2\"/></bsdf>"),
              "scene.xml:3:53: both material and k are given, expected one of them");
    EXPECT_EQ(error("<bsdf type=\"conductor\">\n<spectrum name=\"eta\" value=\"400:1.6 700:-0.2\"/></bsdf>"),
              "scene.xml:3:22: eta is negative at 700 nm: -0.2");
    EXPECT_EQ(error("<bsdf type=\"conductor\">\n<rgb name=\"k\" value=\"3.9, -2.4, 2.2\"/></bsdf>"),
              "scene.xml:3:15: k is negative: '3.9, -2.4, 2.2'");
    EXPECT_EQ(error("<bsdf type=\"conductor\">\n<float name=\"int_ior\" value=\"1\"/></bsdf>"),
              "scene.xml:3:8: unknown parameter 'int_ior' of bsdf 'conductor'; allowed: material, eta, k, specular_reflectance");
}

TEST_F(XmlValueErrors, RoughConductors) {
    const auto rough_error = [&](const std::string& inside) {
        return error("<bsdf type=\"roughconductor\">\n" + inside + "</bsdf>");
    };
    EXPECT_EQ(rough_error("<string name=\"distribution\" value=\"phong\"/>"),
              "scene.xml:3:29: distribution is 'phong'; allowed: beckmann, ggx");
    EXPECT_EQ(rough_error("<float name=\"alpha\" value=\"0\"/>"),
              "scene.xml:3:21: alpha is 0, expected at least 0.0001; bsdf 'conductor' is smooth");
    EXPECT_EQ(rough_error("<float name=\"alpha_u\" value=\"0.1\"/><float name=\"alpha_v\" value=\"0\"/>"),
              "scene.xml:3:58: alpha_v is 0, expected at least 0.0001; bsdf 'conductor' is smooth");
    EXPECT_EQ(rough_error("<float name=\"alpha_v\" value=\"0.1\"/>"),
              "scene.xml:3:23: alpha_v is given without alpha_u, expected both, or alpha");
    EXPECT_EQ(rough_error("<float name=\"alpha\" value=\"0.1\"/><float name=\"alpha_u\" value=\"0.3\"/>"),
              "scene.xml:3:56: both alpha and alpha_u are given, expected one of them");
    EXPECT_EQ(rough_error("<float name=\"alpha_u\" value=\"0\"/><float name=\"alpha_v\" value=\"0\"/>"),
              "scene.xml:3:23: alpha_u is 0, expected at least 0.0001; bsdf 'conductor' is smooth\n"
              "scene.xml:3:56: alpha_v is 0, expected at least 0.0001; bsdf 'conductor' is smooth");
    EXPECT_EQ(rough_error("<float name=\"roughness\" value=\"0.1\"/>"),
              "scene.xml:3:8: unknown parameter 'roughness' of bsdf 'roughconductor'; allowed: material, eta, k, "
              "specular_reflectance, distribution, alpha, alpha_u, alpha_v, sample_visible");
}

TEST_F(XmlValueErrors, Plastics) {
    const auto plastic = [&](const std::string& inside) { return error("<bsdf type=\"plastic\">\n" + inside + "</bsdf>"); };
    const auto rough = [&](const std::string& inside) { return error("<bsdf type=\"roughplastic\">\n" + inside + "</bsdf>"); };
    EXPECT_EQ(plastic("<float name=\"int_ior\" value=\"0\"/>"), "scene.xml:3:23: int_ior is 0, expected more than 0");
    EXPECT_EQ(
        plastic("<string name=\"ext_ior\" value=\"honey\"/>"),
        "scene.xml:3:24: ext_ior is 'honey'; allowed: vacuum, helium, hydrogen, air, carbon dioxide, water, acetone, ethanol, "
        "carbon tetrachloride, glycerol, benzene, silicone oil, bromine, water ice, fused quartz, pyrex, acrylic glass, "
        "polypropylene, bk7, sodium chloride, amber, pet, diamond, or a number");
    EXPECT_EQ(plastic("<float name=\"alpha\" value=\"0.1\"/>"),
              "scene.xml:3:8: unknown parameter 'alpha' of bsdf 'plastic'; allowed: int_ior, ext_ior, diffuse_reflectance, "
              "specular_reflectance, nonlinear");
    EXPECT_EQ(rough("<float name=\"int_ior\" value=\"1.5\"/><float name=\"ext_ior\" value=\"1.5\"/>"),
              "scene.xml:3:23: int_ior and ext_ior of bsdf 'roughplastic' are the same, expected different ones");
    EXPECT_EQ(
        rough("<float name=\"alpha_u\" value=\"0.1\"/><float name=\"alpha_v\" value=\"0.3\"/>"),
        "scene.xml:3:58: alpha_u is 0.1 and alpha_v is 0.3, expected the same: bsdf 'roughplastic' is alike in all directions");
}

TEST_F(XmlValueErrors, Principled) {
    const auto principled = [&](const std::string& inside) { return error("<bsdf type=\"principled\">\n" + inside + "</bsdf>"); };
    EXPECT_EQ(principled("<float name=\"metallic\" value=\"1.5\"/>"), "scene.xml:3:24: metallic is 1.5, expected 0 to 1");
    EXPECT_EQ(principled("<float name=\"eta\" value=\"1.5\"/><float name=\"specular\" value=\"0.5\"/>"),
              "scene.xml:3:55: both eta and specular are given, expected one of them");
    EXPECT_EQ(principled("<float name=\"eta\" value=\"0\"/>"), "scene.xml:3:19: eta is 0, expected more than 0");
    EXPECT_EQ(principled("<float name=\"specular\" value=\"2\"/>"), "scene.xml:3:24: specular is 2, expected 0 to 1");
    EXPECT_EQ(principled("<float name=\"diff_trans\" value=\"1\"/>"),
              "scene.xml:3:8: unknown parameter 'diff_trans' of bsdf 'principled'; allowed: base_color, roughness, anisotropic, "
              "spec_trans, spec_tint, sheen, sheen_tint, flatness, metallic, clearcoat, clearcoat_gloss, eta, specular, "
              "main_specular_sampling_rate, clearcoat_sampling_rate, diffuse_reflectance_sampling_rate");
    EXPECT_EQ(error("<bsdf type=\"principledthin\">\n<float name=\"diff_trans\" value=\"3\"/></bsdf>"),
              "scene.xml:3:26: diff_trans is 3, expected 0 to 2");
    EXPECT_EQ(
        error("<bsdf type=\"twosided\">\n<bsdf type=\"principledthin\"><float name=\"diff_trans\" value=\"1\"/></bsdf></bsdf>"),
        "scene.xml:3:1: bsdf 'principledthin' in bsdf 'twosided' lets light through, expected one that only reflects");
}

TEST_F(XmlValueErrors, UnusedDefinitionsAreCheckedToo) {
    EXPECT_EQ(error("<film type='hdrfilm' id='f'><integer name='width' value='0'/></film>"),
              "scene.xml:2:51: film width is 0, expected at least 1");
}

}  // namespace neumann::xml_value_errors_test
