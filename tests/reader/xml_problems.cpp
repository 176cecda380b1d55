// Everything that is wrong with a scene is told at once, and nothing that only follows from it.
#include "tests/reader/xml_scene_files.h"

#include <fmt/format.h>

namespace neumann::xml_problems_test {

class XmlProblems : public XmlTest {
protected:
    // Messages of several lines, each with its newline.
    std::string errors(const std::string& body, const Definitions& definitions = {}) const {
        return error(body, definitions) + "\n";
    }
};

TEST_F(XmlProblems, OfIndependentElements) {
    write("bad.obj", "v 0 0 0\nv 1 0\n");
    EXPECT_EQ(
        file_error(
            "<scene version='3.0.0'>\n"
            "<integrator type='path'><integer name='max_depth' value='0'/></integrator>\n"
            "<sensor type='perspective'>\n"
            "<float name='fov' value='-1'/>\n"
            "<float name='near_clip' value='far'/>\n"
            "<float name='apperture' value='1'/>\n"
            "<film type='hdrfilm'>\n<integer name='width' value='0'/>\n<rfilter type='cone'/></film></sensor>\n"
            "<bsdf type='roughconductor' id='metal'>\n"
            "<float name='alpha' value='rough'/>\n"
            "<boolean name='eta' value='true'/>\n"
            "<texture type='bitmap' name='specular_reflectance'>\n<string name='filename' value='none.png'/></texture></bsdf>\n"
            "<shape type='obj'>\n<string name='filename' value='bad.obj'/>\n<float name='radius' value='1'/></shape>\n"
            "<shape type='teapot'><bsdf type='wood'/></shape>\n"
            "<emitter type='point'><rgb name='intensity' value='1, 2'/></emitter>\n"
            "<shape type='sphere'><ref id='metal'/><ref id='glass'/></shape>\n"
            "</scene>\n"),
        "scene.xml:2:51: max_depth is 0, expected -1 or at least 1\n"
        "scene.xml:4:19: fov is -1, expected more than 0 and less than 180 degrees\n"
        "scene.xml:5:25: 'far' is not a number\n"
        "scene.xml:6:8: unknown parameter 'apperture' of sensor 'perspective'; allowed: to_world, fov_axis, fov, focal_length, "
        "near_clip, far_clip, focus_distance, principal_point_offset_x, principal_point_offset_y\n"
        "scene.xml:8:23: film width is 0, expected at least 1\n"
        "scene.xml:9:10: rfilter type 'cone' is not supported; allowed: box, catmullrom, gaussian, lanczos, mitchell, tent\n"
        "scene.xml:11:21: 'rough' is not a number\n"
        "scene.xml:12:1: parameter 'eta' of bsdf 'roughconductor' is a boolean, expected rgb, spectrum, float or integer\n"
        "scene.xml:14:25: there is no file 'none.png'; looked in: .\n"
        "bad.obj:2:6: expected a number, found the end of the line\n"
        "scene.xml:17:8: unknown parameter 'radius' of shape 'obj'; allowed: to_world, filename, flip_normals, face_normals, "
        "flip_tex_coords\n"
        "scene.xml:18:8: shape type 'teapot' is not supported; allowed: "
        "bsplinecurve, cube, cylinder, disk, instance, linearcurve, merge, obj, ply, rectangle, serialized, shapegroup, sphere\n"
        "scene.xml:18:28: bsdf type 'wood' is not supported; allowed: blendbsdf, bumpmap, coating, conductor, dielectric, diffuse, "
        "mask, "
        "mixturebsdf, normalmap, null, phong, plastic, principled, principledthin, retroreflector, roughconductor, "
        "roughdielectric, roughplastic, thindielectric, twosided, ward\n"
        "scene.xml:19:45: '1, 2' has 2 numbers, expected 1 or 3\n"
        "scene.xml:20:44: reference to 'glass', which is not defined; defined: metal");
}

// The main file's come first, then those of the files that it includes, in the order in which they are read.
TEST_F(XmlProblems, AcrossIncludedFiles) {
    write("a.xml", "<scene version='3.0.0'>\n<bsdf type='clay'/>\n<include filename='none.xml'/>\n</scene>");
    write("b.xml", "<scene version='3.0.0'>\n<shape type='cube'>\n</scene>");
    write("c.xml", "<bsdf version='3.0.0' type='diffuse'>\n<rgb name='reflectance' value='x'/></bsdf>");
    EXPECT_EQ(
        errors("<include filename='a.xml'/>\n"
               "<shape type='sphere'><float name='radius' value='0'/></shape>\n"
               "<include filename='b.xml'/>\n"
               "<shape type='cube'><include filename='c.xml'/></shape>\n"
               "<shape type='disk'><float name='radius' value='1'/></shape>\n"),
        "scene.xml:3:43: radius is 0, expected more than 0\n"
        "scene.xml:6:27: unknown parameter 'radius' of shape 'disk'; allowed: flip_normals, to_world\n"
        "a.xml:2:7: bsdf type 'clay' is not supported; allowed: blendbsdf, bumpmap, coating, conductor, dielectric, diffuse, mask, "
        "mixturebsdf, normalmap, null, phong, plastic, principled, principledthin, retroreflector, roughconductor, "
        "roughdielectric, roughplastic, thindielectric, twosided, ward\n"
        "a.xml:3:10: there is no file 'none.xml'; looked in: .\n"
        "b.xml:3:3: broken XML: Start-end tags mismatch\n"
        "c.xml:2:25: 'x' is not a number\n");
}

TEST_F(XmlProblems, OfTheDocument) {
    EXPECT_EQ(errors("<bsdf type='diffuse' colour='red'/>\n"
                     "<medium type='homogeneous'/>\n"
                     "<shape type='cube'>words<transform name='to_world'><shear/><scale value='$size'/></transform></shape>\n"
                     "<bsdf type='diffuse' id='a'/>\n<bsdf type='diffuse' id='a'/>\n"
                     "<path value='nowhere'/>\n"
                     "<shape type='sphere'>\n<float name='radius'/></shape>\n"),
              "scene.xml:2:22: unknown attribute 'colour' of <bsdf>; allowed: type, id, name\n"
              "scene.xml:3:1: <medium> is not supported: media are not simulated, only surfaces\n"
              "scene.xml:4:1: <shape> contains the text 'words', expected elements only\n"
              "scene.xml:4:52: <shear> is not supported in <transform>; allowed: lookat, matrix, rotate, scale, translate\n"
              "scene.xml:4:67: $size is not defined; no parameter is\n"
              "scene.xml:6:22: the id 'a' is taken already, at scene.xml:5:22\n"
              "scene.xml:7:7: there is no folder 'nowhere'\n"
              "scene.xml:9:1: <float> lacks the attribute 'value'\n");
}

// What hangs on something that is wrong already says nothing of its own.
TEST_F(XmlProblems, NothingFollows) {
    const auto alone = [&](const std::string& message, const std::string& body) { EXPECT_EQ(error(body), message) << body; };
    const std::string wrong = "<bsdf type='diffuse' id='a'><float name='reflectance' value='x'/></bsdf>";
    // References to what is wrong, from several places, and through other materials.
    alone("scene.xml:2:55: 'x' is not a number", wrong +
                                                     "<alias id='a' as='b'/><bsdf type='twosided' id='t'><ref id='a'/></bsdf>"
                                                     "<shape type='cube'><ref id='b'/></shape><shape type='disk'><ref "
                                                     "id='a'/></shape><shape type='sphere'><ref id='t'/></shape>");
    // Ids of what could not be read.
    alone("scene.xml:2:10: there is no file 'materials.xml'; looked in: .",
          "<include filename='materials.xml'/><shape type='cube'><ref id='of a file'/></shape>");
    alone(
        "scene.xml:2:1: <matter> is not supported in <scene>; allowed: alias, bsdf, default, emitter, film, include, integrator, "
        "path, "
        "rfilter, sampler, sensor, shape, texture",
        "<matter type='diffuse' id='m'/><bsdf type='twosided'><ref id='m'/></bsdf><shape type='cube'><ref id='m'/></shape>");
    alone("scene.xml:2:8: alias of 'foo', which is not defined; no object has an id",
          "<alias id='foo' as='bar'/><shape type='cube'><ref id='bar'/></shape>");
    alone("scene.xml:2:39: reference to 'foo', which is not defined; no object has an id",
          "<bsdf type='mask'><ref name='opacity' id='foo'/><bsdf type='diffuse'/></bsdf>");
    alone("scene.xml:2:28: reference to 'foo', which is not defined; no object has an id",
          "<bsdf type='twosided'><ref id='foo'/></bsdf>");
    // Files in a folder that is not there, and names that a <default> gives.
    alone("scene.xml:2:7: there is no folder 'meshes'",
          "<path value='meshes'/><shape type='obj'><string name='filename' value='a.obj'/></shape>");
    alone("scene.xml:2:10: unknown attribute 'nam' of <default>; allowed: name, value; did you mean 'name'?",
          "<default nam='r' value='1'/><shape type='sphere'><float name='radius' value='$r'/></shape>");
    // What is missing, where it was there but not right.
    alone("scene.xml:2:43: unknown attribute 'valu' of <string>; allowed: name, value; did you mean 'value'?",
          "<shape type='obj'><string name='filename' valu='a.obj'/></shape>");
    alone(
        "scene.xml:2:23: <material> is not supported in <bsdf>; allowed: boolean, bsdf, default, emitter, film, float, include, "
        "integer, integrator, point, ref, rfilter, rgb, sampler, sensor, shape, spectrum, string, texture, transform, vector",
        "<bsdf type='twosided'><material type='diffuse'/></bsdf>");
    alone("scene.xml:2:69: there is no file 'none.exr'; looked in: .",
          "<emitter type='area'><texture name='radiance' type='bitmap'><string value='none.exr' "
          "name='filename'/></texture></emitter>");
    alone("scene.xml:2:7: unknown attribute 'typ' of <film>; allowed: type, id, name; did you mean 'type'?",
          "<film typ='hdrfilm'/>");
    alone("scene.xml:2:7: unknown attribute 'typ' of <bsdf>; allowed: type, id, name; did you mean 'type'?",
          "<bsdf typ='diffuse' id='d'/><shape type='cube'><ref id='d'/></shape>");
    // Values that are compared with one that is wrong.
    alone("scene.xml:2:52: '-' is not a number",
          "<bsdf type='roughdielectric'><float name='ext_ior' value='-'/>"
          "<float name='int_ior' value='1.000277'/></bsdf>");
    alone(
        "scene.xml:2:7: bsdf type 'clay' is not supported; allowed: blendbsdf, bumpmap, coating, conductor, dielectric, diffuse, "
        "mask, "
        "mixturebsdf, normalmap, null, phong, plastic, principled, principledthin, retroreflector, roughconductor, "
        "roughdielectric, roughplastic, thindielectric, twosided, ward",
        "<bsdf type='clay' id='c'/><shape type='shapegroup' id='g'><shape type='cube'><ref id='c'/></shape></shape>"
        "<shape type='instance'><ref id='g'/></shape>");
    EXPECT_EQ(file_error("<scene version='3.0.0'>\n<sensr type='perspective'/></scene>").find('\n'), std::string::npos);
    EXPECT_EQ(file_error("<scene version='3.0.0'>\n<sensor type='periscope'/></scene>").find('\n'), std::string::npos);
}

// A mesh's file is read by several shapes; what is wrong with it is said once, where the first of them stands.
TEST_F(XmlProblems, OfMeshes) {
    write("a.obj", "v 0 0\n");
    write("b.ply", "ply\n");
    const auto shape = [](const std::string& type, const std::string& file) {
        return "<shape type='" + type + "'><string name='filename' value='" + file + "'/></shape>\n";
    };
    EXPECT_EQ(errors(shape("ply", "b.ply") + "<bsdf type='diffuse'><float name='x' value='1'/></bsdf>\n" + shape("obj", "a.obj") +
                     shape("obj", "a.obj") + shape("serialized", "none")),
              "b.ply: ends before 'end_header'\n"
              "scene.xml:3:29: unknown parameter 'x' of bsdf 'diffuse'; allowed: reflectance\n"
              "a.obj:1:6: expected a number, found the end of the line\n"
              "scene.xml:6:50: there is no file 'none'; looked in: .\n");
}

TEST_F(XmlProblems, OfOldFiles) {
    EXPECT_EQ(file_error("<scene version='0.5.0'>\n<sensor type='perspective'><float name='fov' value='40'/></sensor>\n"
                         "<shape type='sphere'>\n<boolean name='flipNormals' value='maybe'/>\n<float name='radios' value='1'/>"
                         "<bsdf type='conductor'>\n<float name='extEta' value='1.5'/></bsdf></shape>\n"
                         "<bsdf type='diffuse'><srgb name='reflectance' value='#ffffff'/>\n"
                         "<rgb name='diffuseReflectance' value='1, 2'/></bsdf></scene>"),
              "scene.xml:4:29: 'maybe' is not a boolean, expected true or false\n"
              "scene.xml:5:8: unknown parameter 'radios' of shape 'sphere'; allowed: flip_normals, to_world, center, radius; did "
              "you mean 'radius'?\n"
              "scene.xml:6:22: extEta of bsdf 'conductor' is '1.5', expected 1 or air; eta and k divided by it say the same\n"
              "scene.xml:7:22: <srgb> is not supported in <bsdf>; allowed: boolean, bsdf, default, emitter, film, float, include, "
              "integer, integrator, point, ref, rfilter, rgb, sampler, sensor, shape, spectrum, string, texture, transform, "
              "vector; did you mean 'rgb'?\n"
              "scene.xml:8:32: '1, 2' has 2 numbers, expected 1 or 3");
}

TEST_F(XmlProblems, ManyAreCounted) {
    std::string body, expected;
    for (int i = 0; i < 30; ++i) {
        body += "<shape type='sphere'><float name='radius' value='0'/></shape>\n";
        if (i < 20) expected += fmt::format("scene.xml:{}:43: radius is 0, expected more than 0\n", i + 2);
    }
    EXPECT_EQ(error(body), expected + "and 10 more");
}

}  // namespace neumann::xml_problems_test
